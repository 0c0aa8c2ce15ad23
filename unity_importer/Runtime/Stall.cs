using UnityEngine;

namespace Garage.Unity
{
    /// <summary>A parking stall. Its object stands in its middle and looks as a car does that is parked
    /// nose-in.</summary>
    [DisallowMultipleComponent]
    [AddComponentMenu("Garage/Stall")]
    public sealed class Stall : MonoBehaviour
    {
        [SerializeField] string id = "";
        [SerializeField] string number = "";
        [SerializeField] string type = "";
        [SerializeField] string use = "";
        [SerializeField] string entryEdge = "";
        [SerializeField] string kind = "";
        [SerializeField] string size = "";
        [SerializeField] float angleRad;
        [SerializeField] Vector2Int square;
        [SerializeField] bool isOccupied;
        [SerializeField] Transform car;
        [SerializeField] int accessNode = -1;
        [SerializeField] Vector3[] corners = new Vector3[0];

        /// <summary>"Stall_r03_c07_2": the second one on the square in row 3, column 7; on a level of several
        /// "U2/Stall_r03_c07_2".</summary>
        public string Id
        {
            get { return id; }
        }

        /// <summary>Name of its level, "U2"; empty in a garage of one level.</summary>
        public string Level
        {
            get { return id.Substring(0, id.IndexOf('/') + 1).TrimEnd('/'); }
        }

        /// <summary>As painted, with its zone: "B2-07", and after its level: "U2/B2-07"; empty where nobody
        /// parks.</summary>
        public string Number
        {
            get { return number; }
        }

        /// <summary>"type_1" to "type_4".</summary>
        public string Type
        {
            get { return type; }
        }

        /// <summary>"standard", "turning", "ev", "accessible", "access_aisle", "unreachable" or "motorcycle".</summary>
        public string Use
        {
            get { return use; }
        }

        /// <summary>"perpendicular", "angled" or "parallel".</summary>
        public string Kind
        {
            get { return kind; }
        }

        /// <summary>Size class: "standard", "compact", "large", "van" or "motorcycle".</summary>
        public string Size
        {
            get { return size; }
        }

        /// <summary>Angle in radians of its long sides to the lane: pi / 2 where it is perpendicular.</summary>
        public float AngleRad
        {
            get { return angleRad; }
        }

        /// <summary>"up", "down", "left" or "right": the edge of its square that its mouth lies on.</summary>
        public string EntryEdge
        {
            get { return entryEdge; }
        }

        /// <summary>Row in x and column in y of the square that it lies on.</summary>
        public Vector2Int Square
        {
            get { return square; }
        }

        /// <summary>Whether the stage says that a car stands in it.</summary>
        public bool IsOccupied
        {
            get { return isOccupied; }
        }

        /// <summary>The car that stands in it; null where none does, or where it was destroyed.</summary>
        public Transform Car
        {
            get { return car; }
        }

        /// <summary>Number of the node of the lane graph before its mouth; -1 where there is no graph.</summary>
        public int AccessNode
        {
            get { return accessNode; }
        }

        /// <summary>Whether cars park there.</summary>
        public bool TakesCars
        {
            get { return use != "turning" && use != "access_aisle" && use != "unreachable" && use != "motorcycle"; }
        }

        /// <summary>0 mouth left, 1 mouth right, 2 rear right, 3 rear left, as the stage has them; metres in the
        /// world.</summary>
        public Vector3 Corner(int index)
        {
            return transform.TransformPoint(corners[index]);
        }

        /// <summary>The middle between the corners, in the world.</summary>
        public Vector3 Centre
        {
            get
            {
                return corners.Length == 4 ? (Corner(0) + Corner(1) + Corner(2) + Corner(3)) * 0.25f
                    : transform.position;
            }
        }

        /// <summary>The middle of the side that cars come through, in the world.</summary>
        public Vector3 Mouth
        {
            get { return corners.Length == 4 ? (Corner(0) + Corner(1)) * 0.5f : transform.position; }
        }

        internal void Set(string ownId, string paintedNumber, string ownType, string ownUse, string edge,
            Vector2Int ownSquare, bool holdsCar)
        {
            id = ownId;
            number = paintedNumber;
            type = ownType;
            use = ownUse;
            entryEdge = edge;
            square = ownSquare;
            isOccupied = holdsCar;
        }

        internal void SetShape(string ownKind, string ownSize, float ownAngleRad)
        {
            kind = ownKind;
            size = ownSize;
            angleRad = ownAngleRad;
        }

        internal void SetCar(Transform parked)
        {
            car = parked;
        }

        /// <summary>Corners in metres of the object's own space.</summary>
        internal void SetPlace(Vector3[] ownCorners, int node)
        {
            corners = ownCorners;
            accessNode = node;
        }

        void OnDrawGizmosSelected()
        {
            if (corners.Length != 4) { return; }
            Gizmos.color = TakesCars ? Color.green : Color.yellow;
            for (int i = 0; i < 4; i++) { Gizmos.DrawLine(Corner(i), Corner((i + 1) % 4)); }
            Gizmos.DrawLine(Mouth, Centre);
        }
    }
}
