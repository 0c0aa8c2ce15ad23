using System;
using System.Collections;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Threading;
using NUnit.Framework;
using UnityEngine.TestTools;

namespace Garage.Unity.TestRun
{
    /// <summary>Runs the tests of assemblies, written for Unity's test runner, on the fakes: TestRun PROJECT TESTS.dll
    /// ... A line each.</summary>
    static class Program
    {
        static int Main(string[] arguments)
        {
            Directory.CreateDirectory(Path.Combine(arguments[0], "Assets"));
            Directory.SetCurrentDirectory(arguments[0]);
            int failed = 0;
            for (int i = 1; i < arguments.Length; i++)
            {
                foreach (Type type in Assembly.LoadFrom(arguments[i]).GetTypes())
                {
                    foreach (MethodInfo method in type.GetMethods())
                    {
                        if (!Has<TestAttribute>(method) && !Has<UnityTestAttribute>(method)) { continue; }
                        string outcome = Outcome(type, method);
                        failed += outcome == "passed" ? 0 : 1;
                        Console.WriteLine(type.Name + "." + method.Name + "\t" + outcome.Replace("\n", " "));
                    }
                }
            }
            return failed;
        }

        static bool Has<T>(MethodInfo method)
        {
            return method.GetCustomAttributes(typeof(T), true).Length > 0;
        }

        static string Outcome(Type type, MethodInfo method)
        {
            object fixture = Activator.CreateInstance(type);
            try
            {
                Call<SetUpAttribute>(fixture);
                var frames = method.Invoke(fixture, null) as IEnumerator;
                if (frames != null) { Finish(frames); }
                return "passed";
            }
            catch (TargetInvocationException failure)
            {
                return "failed: " + failure.InnerException;
            }
            catch (AssertionException failure)
            {
                return "failed: " + failure;
            }
            finally
            {
                Call<TearDownAttribute>(fixture);
            }
        }

        static void Call<T>(object fixture)
        {
            foreach (MethodInfo method in fixture.GetType().GetMethods())
            {
                if (Has<T>(method)) { method.Invoke(fixture, null); }
            }
        }

        // a frame for each step, and whatever a step waits for before
        static void Finish(IEnumerator frames)
        {
            var stack = new Stack<IEnumerator>();
            stack.Push(frames);
            while (stack.Count > 0)
            {
                if (!stack.Peek().MoveNext())
                {
                    stack.Pop();
                    continue;
                }
                var inner = stack.Peek().Current as IEnumerator;
                if (inner != null) { stack.Push(inner); }
                else { Thread.Sleep(1); }
            }
        }
    }
}
