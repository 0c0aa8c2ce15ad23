"""Whether each member of Unity's that the package uses exists, with that signature, in Unity's reference sources.

    python check_signatures.py CHECKOUT TAG ... [--write]

CHECKOUT is a clone of the UnityCsReference repository, bare or not; tags are such as 2021.3.58f1 and 6000.0.78f1. The
members are read from the compiled package, so that nothing which is called is missed; those of enumerations from its
sources, as compiled code has only their numbers. With --write the result goes into Documentation~/signatures.md.
"""

import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from declarations import Declared, Member, declarations, matches, stripped

PACKAGE = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PACKAGE.parent / "tests"))

from support.unity.layer import EDITOR, UNITY_6, compile_assembly, compile_package, sources_of  # noqa: E402

SPACES = ("UnityEngine", "UnityEditor", "UnityEditor.AssetImporters")
FIRST_UNITY_6 = 6000
HEADING = """\
# Signatures

Written by `Tools~/check_signatures.py`: every member of Unity's that the compiled package uses (runtime, editor, tests
and sample), looked up in Unity's public C# reference sources.

| Unity | members | declared as they are used | of these obsolete | missing |
|---|---|---|---|---|
"""


def used_members(folder: Path, *defines: str) -> list[Member]:
    """Members that the package uses, found in what it compiles to."""
    assemblies = compile_package(folder, EDITOR, *defines)
    program = folder / "MemberList.exe"
    compile_assembly(program, sources_of("Tools~/MemberList"), [], ())
    paths = [folder / f"{name}.dll" for name in ("UnityFakes", *assemblies)]
    done = subprocess.run(["mono", program, *paths], check=True, capture_output=True, text=True)
    members, enums = [], {}
    for line in done.stdout.splitlines():
        kind, namespace, type_name, name, result, *parameters = line.split("\t")
        static = result.startswith("static ")
        member = Member(kind, namespace, type_name, name, result.removeprefix("static "), tuple(parameters), static)
        if kind == "enum":
            enums.setdefault(type_name, []).append(member)
        elif kind != "value":
            members.append(member)
    text = "\n".join(source.read_text() for source in sources_of("Runtime", "Editor", "Tests", "Samples~"))
    for type_name, values in enums.items():
        named = set(re.findall(rf"\b{type_name}\.(\w+)", text))
        members += [
            Member("value", one.namespace, type_name, one.name, one.result) for one in values if one.name in named
        ]
    return members


class Reference:
    """The sources of one tag."""

    def __init__(self, checkout: Path, tag: str) -> None:
        self.checkout, self.tag = checkout, tag
        self.texts: dict[str, str] = {}
        self.types: dict[tuple[str, str], Declared | None] = {}

    def git(self, *arguments: str) -> str:
        """What git prints."""
        done = subprocess.run(["git", "-C", self.checkout, *arguments], check=False, capture_output=True)
        return done.stdout.decode("utf-8", "replace")

    def type(self, namespace: str, name: str) -> Declared | None:
        """A type with all its parts; None where it is not declared."""
        key = namespace, name
        if key not in self.types:
            self.types[key] = None
            pattern = rf"(class|struct|enum|interface) +{name.rpartition('.')[2]}\b"
            for line in self.git("grep", "-lE", pattern, self.tag, "--", "*.cs", ":!*/Tests/*").splitlines():
                path = line.partition(":")[2]
                if path not in self.texts:
                    self.texts[path] = stripped(self.git("show", f"{self.tag}:{path}"))
                for part in declarations(self.texts[path], namespace, name):
                    if self.types[key] is None:
                        self.types[key] = part
                    else:
                        self.types[key].join(part)
        return self.types[key]

    def find(self, member: Member) -> str:
        """``declared``, ``obsolete`` or ``missing``."""
        declared = self.type(member.namespace, member.type)
        if declared is None:
            return "missing"
        if member.kind == "type":
            return "obsolete" if declared.is_obsolete else "declared"
        if member.kind == "value":
            number = declared.values.get(member.name, "none")
            return "declared" if number is None or str(number) == member.result else "missing"
        seen = set()
        queue = [declared]
        while queue:
            here = queue.pop(0)
            for header, body in here.members:
                state = matches(member, header, body)
                if state:
                    return state
            for base in here.bases:
                bare = re.sub(r"<.*", "", base).rpartition(".")[2]
                if bare not in seen and member.kind != "constructor":
                    seen.add(bare)
                    queue += filter(None, (self.type(space, bare) for space in (member.namespace, *SPACES)))
        if member.kind != "constructor" or member.parameters:
            return "missing"
        # a type that declares none has one without parameters
        own = rf"\b{member.type}\s*\("
        return "missing" if any(re.search(own, header) for header, _ in declared.members) else "declared"


def check(checkout: Path, tag: str) -> tuple[int, dict[str, list[Member]]]:
    """How many members are used, and those that are obsolete or missing."""
    defines = (UNITY_6,) if int(tag.partition(".")[0]) >= FIRST_UNITY_6 else ()
    reference = Reference(checkout, tag)
    with tempfile.TemporaryDirectory() as folder:
        members = used_members(Path(folder), *defines)
    odd: dict[str, list[Member]] = {"obsolete": [], "missing": []}
    for member in members:
        state = reference.find(member)
        if state != "declared":
            odd[state].append(member)
    return len(members), odd


def main() -> int:
    """Check all tags."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkout", type=Path)
    parser.add_argument("tags", nargs="+")
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    table, details, failed = HEADING, "", False
    for tag in arguments.tags:
        count, odd = check(arguments.checkout, tag)
        missing, obsolete = len(odd["missing"]), len(odd["obsolete"])
        table += f"| {tag} | {count} | {count - missing} | {obsolete} | {missing} |\n"
        for state, found in odd.items():
            if found:
                details += f"\n{tag}, {state}:\n\n" + "".join(f"- `{one}`\n" for one in found)
        failed |= missing > 0
    sys.stdout.write(table + details)
    if arguments.write:
        (PACKAGE / "Documentation~" / "signatures.md").write_text(table + details)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
