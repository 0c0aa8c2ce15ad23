using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("PrefabDump")]
