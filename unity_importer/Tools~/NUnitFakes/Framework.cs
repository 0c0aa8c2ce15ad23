using System;
using System.Collections;

namespace NUnit.Framework
{
    [AttributeUsage(AttributeTargets.Method)]
    public class TestAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Method)]
    public class SetUpAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Method)]
    public class TearDownAttribute : Attribute
    {
    }

    public class AssertionException : Exception
    {
        public AssertionException(string message) : base(message)
        {
        }
    }

    public class Assert
    {
        static void Hold(bool holds, string message)
        {
            if (!holds) { throw new AssertionException(message); }
        }

        static bool Same(object expected, object actual)
        {
            var many = expected as IList;
            var others = actual as IList;
            if (many == null || others == null) { return Equals(expected, actual); }
            bool same = many.Count == others.Count;
            for (int i = 0; same && i < many.Count; i++) { same = Same(many[i], others[i]); }
            return same;
        }

        public static void AreEqual(object expected, object actual)
        {
            Hold(Same(expected, actual), "expected " + expected + ", was " + actual);
        }

        public static void AreEqual(double expected, double actual, double delta)
        {
            Hold(Math.Abs(expected - actual) <= delta, "expected " + expected + ", was " + actual);
        }

        public static void AreSame(object expected, object actual)
        {
            Hold(ReferenceEquals(expected, actual), "expected the same object, " + expected + ", was " + actual);
        }

        public static void Greater(double arg1, double arg2)
        {
            Hold(arg1 > arg2, arg1 + " is not greater than " + arg2);
        }

        public static void Greater(int arg1, int arg2)
        {
            Hold(arg1 > arg2, arg1 + " is not greater than " + arg2);
        }

        public static void IsTrue(bool condition)
        {
            Hold(condition, "is not true");
        }

        public static void IsTrue(bool condition, string message, params object[] args)
        {
            Hold(condition, message);
        }

        public static void IsFalse(bool condition)
        {
            Hold(!condition, "is true");
        }

        public static void IsNotNull(object anObject)
        {
            Hold(anObject != null, "is null");
        }
    }
}

namespace UnityEngine.TestTools
{
    /// <summary>A test over several frames.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    public class UnityTestAttribute : Attribute
    {
    }
}
