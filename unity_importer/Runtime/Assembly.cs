using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Garage.Unity.Editor")]
[assembly: InternalsVisibleTo("Garage.Unity.Tests")]
[assembly: InternalsVisibleTo("Garage.Unity.Editor.Tests")]
[assembly: InternalsVisibleTo("PrefabDump")]
