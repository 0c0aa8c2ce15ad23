using UnityEngine;

namespace Garage.Unity
{
    /// <summary>Plain figures of agents: a car of two boxes on wheels, a capsule, and a box for all others. The origin
    /// is the middle of the rear axle, or of the footprint, on the floor.</summary>
    static class TrafficFigures
    {
        /// <summary>Names of the wheels of a car, those in front first.</summary>
        public static readonly string[] Wheels =
        {
            "FrontLeftWheel", "FrontRightWheel", "RearLeftWheel", "RearRightWheel",
        };

        const float WheelOfHeight = 0.2f, ClearanceOfHeight = 0.12f, BonnetOfHeight = 0.6f, CabinOfLength = 0.6f;

        public static GameObject Make(TrafficAgent agent)
        {
            var figure = new GameObject();
            Vector3 size = agent.Size;
            if (agent.Wheelbase > 0) { MakeCar(figure.transform, agent, size); }
            else if (agent.Kind == "person")
            {
                // a capsule is two high and one wide
                Part(figure.transform, PrimitiveType.Capsule, new Vector3(0, size.y / 2, 0),
                    new Vector3(size.x, size.y / 2, size.x));
            }
            else { Part(figure.transform, PrimitiveType.Cube, new Vector3(0, size.y / 2, 0), size); }
            return figure;
        }

        static void MakeCar(Transform car, TrafficAgent agent, Vector3 size)
        {
            float low = ClearanceOfHeight * size.y, bonnet = BonnetOfHeight * size.y, ahead = agent.RearAxle;
            Part(car, PrimitiveType.Cube, new Vector3(0, (low + bonnet) / 2, ahead),
                new Vector3(size.x, bonnet - low, size.z));
            Part(car, PrimitiveType.Cube, new Vector3(0, (bonnet + size.y) / 2, ahead - 0.05f * size.z),
                new Vector3(0.9f * size.x, size.y - bonnet, CabinOfLength * size.z));
            float radius = WheelOfHeight * size.y, width = 0.12f * size.x;
            for (int i = 0; i < Wheels.Length; i++)
            {
                var wheel = new GameObject(Wheels[i]);
                wheel.transform.SetParent(car, false);
                float side = (i & 1) == 0 ? -1 : 1;
                wheel.transform.localPosition = new Vector3(side * (size.x - width) / 2, radius,
                    i < 2 ? agent.Wheelbase : 0);
                // a cylinder stands, two high and one wide
                Transform tyre = Part(wheel.transform, PrimitiveType.Cylinder, Vector3.zero,
                    new Vector3(2 * radius, width / 2, 2 * radius));
                tyre.localRotation = Quaternion.Euler(0, 0, 90);
            }
        }

        static Transform Part(Transform parent, PrimitiveType shape, Vector3 middle, Vector3 scale)
        {
            Transform part = GameObject.CreatePrimitive(shape).transform;
            part.SetParent(parent, false);
            part.localPosition = middle;
            part.localScale = scale;
            return part;
        }
    }
}
