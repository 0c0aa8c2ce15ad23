using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Garage.Unity.Editor.Tests")]
