using System.Text;
using NUnit.Framework;
using UnityEngine;

namespace Garage.Unity.Tests
{
    /// <summary>A car that stands in the stage for a second, drives four metres to the stage's -Z in two, and leaves; a
    /// person who comes in the second second.</summary>
    public sealed class GarageTrafficTests
    {
        const string Table = "agent,time_s,x_m,y_m,z_m,yaw_rad,pitch_rad,speed_m_s,steering_rad,state,level,stall\n"
            + "car_1,0,10,0,0,0,0,0,0.5,parked,0,A\ncar_1,1,10,0,0,0,0,2,0,drives,0,A\n"
            + "car_1,3,10,0,-4,0,0,2,0,waits,0,\n"
            + "person_1,1,0,0,0,0,0,1,0,walks,0,\nperson_1,3,0,0,2,0,0,1,0,walks,0,\n";

        const string Heading = "{\"form\":1,\"samples\":5,\"duration_s\":4.0,\"agents\":["
            + "{\"name\":\"car_1\",\"kind\":\"car\",\"prim\":\"/Garage/Car_3\",\"length_m\":4.0,\"width_m\":1.8,"
            + "\"height_m\":1.5,\"rear_axle_m\":1.25,\"wheelbase_m\":2.5,\"behaviour\":\"double_parks\"},"
            + "{\"name\":\"person_1\",\"kind\":\"person\",\"length_m\":0.3,\"width_m\":0.5,\"height_m\":1.8}]}";

        GameObject root, parked, plate;
        GarageTraffic traffic;

        [SetUp]
        public void MakeGarage()
        {
            root = new GameObject("garage");
            root.transform.localPosition = new Vector3(0, 0, 100);
            var garage = new GameObject("Garage");
            garage.transform.SetParent(root.transform, false);
            parked = new GameObject("Car_3");
            parked.transform.SetParent(garage.transform, false);
            plate = new GameObject("NumberPlate_3");
            plate.transform.SetParent(garage.transform, false);
            traffic = root.AddComponent<GarageTraffic>();
            traffic.Load(Encoding.UTF8.GetBytes(Table), Encoding.UTF8.GetBytes(Heading), root);
        }

        [TearDown]
        public void Remove()
        {
            Object.DestroyImmediate(root);
        }

        [Test]
        public void Agents_are_where_their_tracks_are()
        {
            traffic.Seconds = 2;
            GameObject car = traffic.ObjectOf("car_1");
            Assert.AreEqual(10f, car.transform.position.x, 1e-4f);
            // the rear axle, behind the middle that has driven two metres
            Assert.AreEqual(100 + 2 - 1.25f, car.transform.position.z, 1e-4f);
            Assert.IsTrue(car.activeSelf);
            Assert.AreEqual(99f, traffic.ObjectOf("person_1").transform.position.z, 1e-4f);
            Assert.AreEqual("double_parks", traffic.Tracks.AgentAt(0).Behaviour);
            traffic.Seconds = 3.5;
            Assert.IsFalse(car.activeSelf);
        }

        [Test]
        public void Time_passes_at_its_rate_and_begins_anew()
        {
            Assert.IsTrue(traffic.IsPlaying);
            Assert.IsFalse(traffic.ObjectOf("person_1").activeSelf);
            traffic.Rate = 3;
            traffic.Advance(0.5f);
            Assert.AreEqual(1.5f, (float)traffic.Seconds, 1e-4f);
            Assert.IsTrue(traffic.ObjectOf("person_1").activeSelf);
            traffic.Advance(1);
            Assert.AreEqual(0.5f, (float)traffic.Seconds, 1e-4f);
        }

        [Test]
        public void The_parked_car_comes_back()
        {
            Assert.IsFalse(parked.activeSelf);
            Assert.IsFalse(plate.activeSelf);
            traffic.Clear();
            Assert.IsTrue(parked.activeSelf);
            Assert.IsTrue(plate.activeSelf);
            Assert.IsTrue(traffic.ObjectOf("car_1") == null);
        }
    }
}
