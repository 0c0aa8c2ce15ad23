using System;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine
{
    [Flags]
    public enum HideFlags
    {
        None = 0, HideInHierarchy = 1, HideInInspector = 2, DontSaveInEditor = 4, NotEditable = 8,
            DontSaveInBuild = 16, DontUnloadUnusedAsset = 32,
        DontSave = 52, HideAndDontSave = 61,
    }

    /// <summary>Stores what it is given; equals null when destroyed, as Unity's does.</summary>
    public class Object
    {
        string ownName = "";
        internal bool isDestroyed;

        public virtual string name
        {
            get { return ownName; }
            set { ownName = value ?? ""; }
        }

        public HideFlags hideFlags { get; set; }

        public static void DestroyImmediate(Object obj)
        {
            if (obj == null) { return; }
            var component = obj as Component;
            var holder = obj as GameObject;
            if (obj is Transform) { throw new InvalidOperationException("a Transform goes only with its GameObject"); }
            if (component != null) { component.gameObject.Remove(component); }
            if (holder != null) { holder.DestroyWhole(); }
            obj.isDestroyed = true;
        }

        public static void Destroy(Object obj)
        {
            DestroyImmediate(obj);
        }

        public static T Instantiate<T>(T original, Transform parent) where T : Object
        {
            return Instantiate(original, parent, false);
        }

        public static T Instantiate<T>(T original, Transform parent, bool worldPositionStays) where T : Object
        {
            var source = original as GameObject;
            if (source == null || worldPositionStays)
            {
                throw new NotSupportedException("only GameObjects are cloned here, without their world positions");
            }
            GameObject copy = source.Clone(parent);
            copy.name = source.name + "(Clone)";
            return (T)(Object)copy;
        }

        public static bool operator ==(Object x, Object y)
        {
            bool isGone = ReferenceEquals(x, null) || x.isDestroyed, isOtherGone = ReferenceEquals(y, null)
                || y.isDestroyed;
            return isGone || isOtherGone ? isGone && isOtherGone : ReferenceEquals(x, y);
        }

        public static bool operator !=(Object x, Object y) { return !(x == y); }
        public static implicit operator bool(Object exists) { return exists != null; }
        public override bool Equals(object other) { return ReferenceEquals(this, other); }
        public override int GetHashCode() { return System.Runtime.CompilerServices.RuntimeHelpers.GetHashCode(this); }
        public override string ToString() { return name + " (" + GetType().FullName + ")"; }
    }

    public class MissingReferenceException : Exception
    {
        public MissingReferenceException(string message) : base(message)
        {
        }
    }

    public class ScriptableObject : Object
    {
        public static T CreateInstance<T>() where T : ScriptableObject
        {
            return Activator.CreateInstance<T>();
        }
    }

    public class Component : Object
    {
        public GameObject gameObject { get; internal set; }

        public Transform transform { get { return gameObject.transform; } }

        public override string name
        {
            get { return gameObject.name; }
            set { gameObject.name = value; }
        }

        public T GetComponent<T>() { return gameObject.GetComponent<T>(); }
        public T GetComponentInParent<T>() { return gameObject.GetComponentInParent<T>(); }
        public T[] GetComponentsInChildren<T>() { return gameObject.GetComponentsInChildren<T>(); }
        public T[] GetComponentsInChildren<T>(
            bool includeInactive) { return gameObject.GetComponentsInChildren<T>(includeInactive); }

        internal virtual Component Copy()
        {
            return (Component)MemberwiseClone();
        }
    }

    public class Behaviour : Component
    {
        public bool enabled { get; set; }

        public Behaviour()
        {
            enabled = true;
        }
    }

    public class MonoBehaviour : Behaviour
    {
        sealed class Fields
        {
            public readonly List<FieldInfo> Arrays = new List<FieldInfo>(), Transient = new List<FieldInfo>(),
                References = new List<FieldInfo>();
        }

        static readonly Dictionary<Type, Fields> FieldsOf = new Dictionary<Type, Fields>();

        // public fields and such as are marked are serialised: copies do not share their arrays, and have nothing of
        // all others
        internal override Component Copy()
        {
            Fields fields;
            if (!FieldsOf.TryGetValue(GetType(), out fields))
            {
                fields = new Fields();
                for (Type type = GetType(); type != typeof(MonoBehaviour); type = type.BaseType)
                {
                    foreach (FieldInfo field in type.GetFields(BindingFlags.Instance | BindingFlags.Public
                        | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
                    {
                        bool isSerialised = !field.IsNotSerialized && !field.IsInitOnly
                            && (field.IsPublic || field.IsDefined(typeof(SerializeField), false));
                        if (!isSerialised && !field.FieldType.IsValueType) { fields.Transient.Add(field); }
                        else if (field.FieldType.IsArray) { fields.Arrays.Add(field); }
                        else if (typeof(Object).IsAssignableFrom(field.FieldType)) { fields.References.Add(field); }
                        else if (!field.FieldType.IsValueType && field.FieldType != typeof(string))
                        {
                            throw new NotSupportedException("no copy is made here of " + type.Name + "." + field.Name);
                        }
                    }
                }
                FieldsOf.Add(GetType(), fields);
            }
            var copy = (MonoBehaviour)MemberwiseClone();
            foreach (FieldInfo field in fields.Arrays)
            {
                var array = (Array)field.GetValue(this);
                if (array != null) { field.SetValue(copy, array.Clone()); }
            }
            foreach (FieldInfo field in fields.Transient) { field.SetValue(copy, null); }
            return copy;
        }

        /// <summary>Lets a copy refer to the copies of what was cloned with it, as Unity's does.</summary>
        internal void Refer(Dictionary<Object, Object> copies)
        {
            Object copy;
            Fields fields = FieldsOf[GetType()];
            foreach (FieldInfo field in fields.References)
            {
                var old = (Object)field.GetValue(this);
                if (!ReferenceEquals(old, null) && copies.TryGetValue(old, out copy)) { field.SetValue(this, copy); }
            }
            foreach (FieldInfo field in fields.Arrays)
            {
                var array = field.GetValue(this) as Object[];
                for (int i = 0; array != null && i < array.Length; i++)
                {
                    if (!ReferenceEquals(array[i], null) && copies.TryGetValue(array[i], out copy)) { array[i] = copy; }
                }
            }
        }
    }

    public enum PrimitiveType { Sphere = 0, Capsule = 1, Cylinder = 2, Cube = 3, Plane = 4, Quad = 5 }

    /// <summary>A file of text in a project.</summary>
    public class TextAsset : Object
    {
        internal byte[] stored = new byte[0];

        public byte[] bytes { get { return (byte[])stored.Clone(); } }
    }

    public sealed class GameObject : Object
    {
        // the transform first; few enough to look through
        Component[] components = new Component[4];
        int count;
        bool isActive = true;
        internal int staticFlags;

        public GameObject(string name)
        {
            this.name = name;
            Attach(new Transform());
        }

        public GameObject() : this("New Game Object")
        {
        }

        public Transform transform { get { return (Transform)components[0]; } }
        public int layer { get; set; }
        public string tag { get; set; }
        public bool activeSelf { get { return isActive; } }

        public bool activeInHierarchy
        {
            get { return isActive && (transform.parent == null || transform.parent.gameObject.activeInHierarchy); }
        }

        public void SetActive(bool value)
        {
            isActive = value;
        }

        /// <summary>Its mesh is empty; its collider tells its size: of a cube 1, of the others 2 up and 1
        /// across.</summary>
        public static GameObject CreatePrimitive(PrimitiveType type)
        {
            var made = new GameObject(type.ToString());
            made.AddComponent<MeshFilter>().sharedMesh = new Mesh();
            made.AddComponent<MeshRenderer>();
            if (type == PrimitiveType.Cube) { made.AddComponent<BoxCollider>().size = Vector3.one; }
            else if (type == PrimitiveType.Capsule || type == PrimitiveType.Cylinder)
            {
                CapsuleCollider collider = made.AddComponent<CapsuleCollider>();
                collider.radius = 0.5f;
                collider.height = 2;
                collider.direction = 1;
            }
            else { throw new NotSupportedException("no " + type + " is made here"); }
            return made;
        }

        public T AddComponent<T>() where T : Component
        {
            var component = (Component)Activator.CreateInstance(typeof(T));
            Attach(component);
            return (T)component;
        }

        void Attach(Component component)
        {
            bool isOnlyOne = component is Transform || component is Renderer || component is MeshFilter
                || component is Light || component is Camera;
            for (int i = 0; isOnlyOne && i < count; i++)
            {
                if (components[i].GetType() == component.GetType())
                {
                    throw new InvalidOperationException(name + " has a " + component.GetType().Name + " already");
                }
            }
            component.gameObject = this;
            if (count == components.Length) { Array.Resize(ref components, 2 * count); }
            components[count++] = component;
            var collider = component as Collider;
            if (!ReferenceEquals(collider, null)) { Physics.Know(collider); }
        }

        internal void Remove(Component component)
        {
            int place = Array.IndexOf(components, component);
            Array.Copy(components, place + 1, components, place, --count - place);
        }

        internal void DestroyWhole()
        {
            transform.SetParent(null, false);
            while (transform.childCount > 0) { DestroyImmediate(transform.GetChild(0).gameObject); }
            for (int i = 0; i < count; i++) { components[i].isDestroyed = true; }
        }

        internal GameObject Clone(Transform parent)
        {
            var copies = new Dictionary<Object, Object>();
            GameObject copy = Clone(parent, copies);
            foreach (Object made in copies.Values)
            {
                var behaviour = made as MonoBehaviour;
                if (!ReferenceEquals(behaviour, null)) { behaviour.Refer(copies); }
            }
            return copy;
        }

        GameObject Clone(Transform parent, Dictionary<Object, Object> copies)
        {
            var copy = (GameObject)MemberwiseClone();
            copies.Add(this, copy);
            copy.components = new Component[count];
            for (int i = 0; i < count; i++)
            {
                Component component = components[i].Copy();
                copies.Add(components[i], component);
                component.gameObject = copy;
                copy.components[i] = component;
            }
            Transform place = copy.transform;
            place.MakeLone(transform.childCount);
            if (parent != null) { place.SetParent(parent, false); }
            for (int i = 0; i < transform.childCount; i++) { transform.GetChild(i).gameObject.Clone(place, copies); }
            return copy;
        }

        public T GetComponent<T>()
        {
            for (int i = 0; i < count; i++)
            {
                if (components[i] is T) { return (T)(object)components[i]; }
            }
            return default(T);
        }

        public T[] GetComponents<T>()
        {
            var found = new List<T>();
            for (int i = 0; i < count; i++)
            {
                if (components[i] is T) { found.Add((T)(object)components[i]); }
            }
            return found.ToArray();
        }

        public T GetComponentInParent<T>()
        {
            for (Transform place = transform; place != null; place = place.parent)
            {
                T found = place.gameObject.GetComponent<T>();
                if (found != null) { return found; }
            }
            return default(T);
        }

        public T GetComponentInChildren<T>()
        {
            T[] found = GetComponentsInChildren<T>(false);
            return found.Length > 0 ? found[0] : default(T);
        }

        public T[] GetComponentsInChildren<T>()
        {
            return GetComponentsInChildren<T>(false);
        }

        public T[] GetComponentsInChildren<T>(bool includeInactive)
        {
            var found = new List<T>();
            Collect(found, includeInactive);
            return found.ToArray();
        }

        void Collect<T>(List<T> found, bool includeInactive)
        {
            if (!includeInactive && !isActive) { return; }
            for (int i = 0; i < count; i++)
            {
                if (components[i] is T) { found.Add((T)(object)components[i]); }
            }
            for (int i = 0; i < transform.childCount; i++)
            {
                transform.GetChild(i).gameObject.Collect(found, includeInactive);
            }
        }
    }

    public class Transform : Component
    {
        Transform[] children = new Transform[0];
        int count;
        Transform above;

        public Transform()
        {
            localRotation = Quaternion.identity;
            localScale = Vector3.one;
        }

        public Vector3 localPosition { get; set; }
        public Quaternion localRotation { get; set; }
        public Vector3 localScale { get; set; }
        public int childCount { get { return count; } }

        public Transform parent
        {
            get { return above; }
            set { SetParent(value, true); }
        }

        public Transform GetChild(int index)
        {
            if ((uint)index >= (uint)count) { throw new ArgumentOutOfRangeException("index"); }
            return children[index];
        }

        public Transform Find(string n)
        {
            int slash = n.IndexOf('/');
            string first = slash < 0 ? n : n.Substring(0, slash);
            for (int i = 0; i < count; i++)
            {
                if (children[i].name == first)
                {
                    return slash < 0 ? children[i] : children[i].Find(n.Substring(slash + 1));
                }
            }
            return null;
        }

        public void SetParent(Transform parent, bool worldPositionStays)
        {
            if (worldPositionStays) { throw new NotSupportedException("world positions are not kept here"); }
            if (above != null)
            {
                int place = Array.IndexOf(above.children, this);
                Array.Copy(above.children, place + 1, above.children, place, --above.count - place);
            }
            above = parent;
            if (parent == null) { return; }
            if (parent.count == parent.children.Length)
            {
                Array.Resize(ref parent.children, Math.Max(4, 2 * parent.count));
            }
            parent.children[parent.count++] = this;
        }

        internal void MakeLone(int room)
        {
            above = null;
            children = new Transform[room];
            count = 0;
        }

        public Matrix4x4 localToWorldMatrix
        {
            get
            {
                Matrix4x4 local = Matrix4x4.TRS(localPosition, localRotation, localScale);
                return above == null ? local : above.localToWorldMatrix * local;
            }
        }

        public Matrix4x4 worldToLocalMatrix { get { return localToWorldMatrix.inverse; } }

        public Vector3 position
        {
            get { return localToWorldMatrix.MultiplyPoint3x4(Vector3.zero); }
            set { localPosition = above == null ? value : above.InverseTransformPoint(value); }
        }

        public Quaternion rotation
        {
            get { return above == null ? localRotation : above.rotation * localRotation; }
            set { localRotation = above == null ? value : Quaternion.Inverse(above.rotation) * value; }
        }

        public Vector3 forward { get { return rotation * Vector3.forward; } }
        public Vector3 TransformPoint(Vector3 position) { return localToWorldMatrix.MultiplyPoint3x4(position); }
        public Vector3 InverseTransformPoint(
            Vector3 position) { return localToWorldMatrix.inverse.MultiplyPoint3x4(position); }
        public Vector3 TransformDirection(Vector3 direction) { return rotation * direction; }
    }
}
