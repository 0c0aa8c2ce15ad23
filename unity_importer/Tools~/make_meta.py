"""Writes a ``.meta`` for every file and folder of the package that Unity sees, with GUIDs that come of the paths."""

import hashlib
from pathlib import Path

__all__ = ["guid_of", "meta_text", "seen_by_unity"]

PACKAGE = Path(__file__).resolve().parents[1]
IMPORTER = "Editor/UsdImporter.cs"
KINDS = {
    ".cs": "MonoImporter",
    ".asmdef": "AssemblyDefinitionImporter",
    ".md": "TextScriptImporter",
    ".json": "TextScriptImporter",
    ".usdz": "ScriptedImporter",
}
TAIL = "  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n"
SCRIPT_TAIL = (
    "  externalObjects: {}\n  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n"
    "  icon: {instanceID: 0}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n"
)


def seen_by_unity() -> list[Path]:
    """Files and folders that need a ``.meta``, relative to the package; of samples what is copied into projects."""
    found = []
    for path in sorted(PACKAGE.rglob("*")):
        relative = path.relative_to(PACKAGE)
        hidden = [
            part for part in relative.parts if part.startswith(".") or part.endswith("~") or part == "__pycache__"
        ]
        inside_sample = relative.parts[0] == "Samples~" and hidden == ["Samples~"] and len(relative.parts) > 1
        if path.suffix != ".meta" and (not hidden or inside_sample):
            found.append(relative)
    return found


def guid_of(relative: Path) -> str:
    """32 hexadecimal digits for a path."""
    return hashlib.sha256(f"garage2usd unity_importer/{relative.as_posix()}".encode()).hexdigest()[:32]


def meta_text(relative: Path) -> str:
    """The ``.meta`` of a file or folder."""
    head = f"fileFormatVersion: 2\nguid: {guid_of(relative)}\n"
    if (PACKAGE / relative).is_dir():
        return f"{head}folderAsset: yes\nDefaultImporter:\n{TAIL}"
    kind = (
        "PackageManifestImporter" if relative.name == "package.json" else KINDS.get(relative.suffix, "DefaultImporter")
    )
    if kind == "ScriptedImporter":
        script = f"  script: {{fileID: 11500000, guid: {guid_of(Path(IMPORTER))}, type: 3}}\n"
        return f"{head}{kind}:\n  internalIDToNameTable: []\n{TAIL}{script}"
    return f"{head}{kind}:\n{SCRIPT_TAIL if kind == 'MonoImporter' else TAIL}"


def main() -> None:
    """Write those that are missing or differ, and take away those that nothing is left for."""
    wanted = {PACKAGE / f"{relative}.meta": meta_text(relative) for relative in seen_by_unity()}
    for path in PACKAGE.rglob("*.meta"):
        if path not in wanted:
            path.unlink()
    for path, text in wanted.items():
        path.write_text(text, newline="\n")


if __name__ == "__main__":
    main()
