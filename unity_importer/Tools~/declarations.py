"""What C# sources declare: types, their members, and whether one of them is a member that is asked for."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

__all__ = ["Declared", "Member", "declarations", "matches", "stripped"]

_MODIFIERS = frozenset({
    "public", "protected", "internal", "private", "static", "extern", "virtual", "override", "abstract", "sealed",
    "readonly", "const", "new", "partial", "unsafe", "volatile", "async", "event",
})  # fmt: skip
_OPERATORS = {
    "op_Implicit": "implicit operator",
    "op_Explicit": "explicit operator",
    "op_Equality": "operator ==",
    "op_Inequality": "operator !=",
    "op_Addition": "operator +",
    "op_Subtraction": "operator -",
    "op_UnaryNegation": "operator -",
    "op_Multiply": "operator *",
    "op_Division": "operator /",
}
_TYPE = re.compile(
    r"\b(class|struct|enum|interface)\s+(\w+)\s*(?:<[^>]*>)?\s*(?::([^{]*?))?\s*(?:\bwhere\b.*)?$", re.DOTALL
)


@dataclass(frozen=True)
class Member:
    """A member that something uses.

    Attributes
    ----------
    kind
        ``type``, ``constructor``, ``method``, ``get``, ``set``, ``field`` or ``value`` (of an enumeration).
    namespace, type, name
        Of it; a type's own name is in `type`.
    result
        Its type without namespaces; the number of a value.
    parameters
        Their types without namespaces.
    is_static
        Whether it belongs to the type itself.
    """

    kind: str
    namespace: str
    type: str
    name: str = ""
    result: str = ""
    parameters: tuple[str, ...] = ()
    is_static: bool = False

    def __str__(self) -> str:
        """As sources write it."""
        name = ".".join(filter(None, (self.namespace, self.type, self.name)))
        listed = f"({', '.join(self.parameters)})" if self.kind in {"method", "constructor"} else ""
        return f"{self.kind} {'static ' if self.is_static else ''}{self.result} {name}{listed}"


@dataclass
class Declared:
    """What sources say of a type, all its parts together."""

    bases: list[str] = field(default_factory=list)
    members: list[tuple[str, str]] = field(default_factory=list)
    """Headers and bodies."""
    values: dict[str, int | None] = field(default_factory=dict)
    """Of an enumeration; None where they are worked out of others."""
    is_obsolete: bool = False

    def join(self, part: "Declared") -> None:
        """Take in another part of the type."""
        self.bases += part.bases
        self.members += part.members
        self.values.update(part.values)
        self.is_obsolete |= part.is_obsolete


def stripped(text: str) -> str:
    """Source without comments, strings' contents, and the branches that an editor of a desktop does not compile."""
    text = re.sub(r'@?"(\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.DOTALL)
    text = re.sub(r"'(\\.|[^'\\\n])+'", "' '", text)
    lines: list[str] = []
    branches: list[bool] = []
    for line in text.splitlines():
        word = line.strip()
        if word.startswith("#if"):
            condition = word[3:].strip()
            branches.append(not condition.startswith("!") and condition not in {"false", "UNITY_WEBGL"})
        elif word.startswith("#elif"):
            branches[-1] = False
        elif word.startswith("#else"):
            branches[-1] = not branches[-1]
        elif word.startswith("#endif"):
            branches.pop()
        elif not word.startswith("#") and all(branches):
            lines.append(line)
    return "\n".join(lines)


def declarations(text: str, namespace: str, name: str) -> Iterator[Declared]:
    """The parts of a type in a stripped source; a nested type has the name ``Outer.Inner``."""
    outer, _, inner = name.rpartition(".")
    for space, body in _namespaces(text):
        if space != namespace:
            continue
        types = list(_types(body))
        if outer:
            types = [one for _, _, own, _, inside in types if own == outer for one in _types(inside)]
        for header, kind, own, bases, inside in types:
            if own == inner:
                part = Declared(bases, is_obsolete=_is_obsolete(header))
                if kind == "enum":
                    part.values = _values(inside)
                else:
                    part.members = [piece for piece in _pieces(inside) if not _is_type(piece[0])]
                yield part


def matches(member: Member, header: str, body: str) -> str | None:
    """``declared`` or ``obsolete`` where a header with its body declares the member, else None."""
    state = "obsolete" if _is_obsolete(header) else "declared"
    header = _without_attributes(header)
    is_call = member.kind in {"method", "constructor"}
    agrees = _declares_call(member, header) if is_call else _declares_value(member, header, body)
    return state if agrees else None


def _declares_call(member: Member, header: str) -> bool:
    head, bracket, rest = header.partition("(")
    words = head.split()
    if not bracket or not {"public", "protected"} & set(words) or member.is_static != ("static" in words):
        return False
    if tuple(_parameter_types(rest[: _closing(rest)])) != member.parameters:
        return False
    if member.kind == "constructor":
        return words[-1] == member.type.rpartition(".")[2]
    if member.name in _OPERATORS:
        return _OPERATORS[member.name].replace(" ", "") in head.replace(" ", "")
    match = re.match(r"(?s)(.*?)\b(\w+)\s*(?:<[^<>]*>)?\s*$", head)
    if match is None or match[2] != member.name:
        return False
    return _plain(" ".join(word for word in match[1].split() if word not in _MODIFIERS)) == member.result


def _declares_value(member: Member, header: str, body: str) -> bool:
    # several fields may be declared at once, each with a value
    head = re.sub(r"=[^,]*", " ", header.partition("=>")[0])
    words = head.split()
    if "(" in head or not {"public", "protected"} & set(words):
        return False
    match = re.match(r"(.+?)\s+(\w+(?:\s*,\s*\w+)*)$", " ".join(word for word in words if word not in _MODIFIERS))
    if match is None or member.name not in re.split(r"\s*,\s*", match[2]) or _plain(match[1]) != member.result:
        return False
    if member.is_static != bool({"static", "const"} & set(words)):
        return False
    if member.kind == "set" and "=>" in header:
        return False
    if member.kind in {"get", "set"} and body:
        accessor = re.search(rf"((?:\w+\s+)*)\b{member.kind}\b", re.sub(r"\[[^\]]*\]", " ", body))
        return accessor is not None and not {"private", "internal"} & set(accessor[1].split())
    return True


# ---- taking a source apart


def _block_end(text: str, start: int) -> int:
    """Where the brace that opens at ``start`` closes."""
    depth = 0
    for match in re.compile(r"[{}]").finditer(text, start):
        depth += 1 if match[0] == "{" else -1
        if depth == 0:
            return match.start()
    return len(text)


def _closing(text: str) -> int:
    """Where the parenthesis closes that opened before a text."""
    depth = 1
    for match in re.finditer(r"[()]", text):
        depth += 1 if match[0] == "(" else -1
        if depth == 0:
            return match.start()
    return len(text)


def _namespaces(text: str, prefix: str = "") -> Iterator[tuple[str, str]]:
    """Names of namespaces with their bodies, nested ones by their whole names."""
    whole = re.search(r"\bnamespace\s+([\w.]+)\s*;", text)
    if whole and not prefix:
        yield whole[1], text[whole.end() :]
        return
    for match in re.finditer(r"\bnamespace\s+([\w.]+)\s*\{", text):
        if text.count("{", 0, match.start()) != text.count("}", 0, match.start()):
            continue
        body = text[match.end() : _block_end(text, match.end() - 1)]
        yield f"{prefix}{match[1]}", body
        yield from _namespaces(body, f"{prefix}{match[1]}.")


def _pieces(text: str) -> Iterator[tuple[str, str]]:
    """Headers of what is declared directly in a body, with their own bodies."""
    start = place = depth = 0
    while place < len(text):
        letter = text[place]
        if letter in "([":
            depth += 1
        elif letter in ")]":
            depth -= 1
        elif depth == 0 and letter == ";":
            yield text[start:place], ""
            start = place + 1
        elif depth == 0 and letter == "{":
            end = _block_end(text, place)
            yield text[start:place], text[place + 1 : end]
            # a property may begin with a value
            rest = re.compile(r"\s*=[^;]*;").match(text, end + 1)
            start = rest.end() if rest else end + 1
            place = start - 1
        place += 1


def _is_type(header: str) -> bool:
    return re.search(r"\b(class|struct|enum|interface)\s+\w+", header.partition("(")[0]) is not None


def _types(text: str) -> Iterator[tuple[str, str, str, list[str], str]]:
    """Header, kind, name, bases and body of each type in a body."""
    for header, body in _pieces(text):
        match = _TYPE.search(header.strip())
        if match:
            bases = [base.strip() for base in (match[3] or "").split(",") if base.strip()]
            yield header, match[1], match[2], bases, body


def _values(text: str) -> dict[str, int | None]:
    values: dict[str, int | None] = {}
    following: int | None = 0
    for entry in re.sub(r"\[[^\]]*\]", " ", text).split(","):
        name, _, number = (part.strip() for part in entry.partition("="))
        if not name:
            continue
        if number:
            try:
                following = sum(_number(part) for part in number.split("|"))
            except ValueError:
                following = values.get(number)
        values[name.split()[-1]] = following
        following = None if following is None else following + 1
    return values


def _number(text: str) -> int:
    """A number, or one shifted left by another."""
    first, _, second = text.strip().strip("()").partition("<<")
    return int(first.strip().rstrip("uUlL"), 0) << int(second.strip() or "0", 0)


def _without_attributes(header: str) -> str:
    """A header without what stands in brackets before it; brackets of array types stay."""
    header = header.strip()
    while header.startswith("["):
        depth = 0
        for match in re.finditer(r"[\[\]]", header):
            depth += 1 if match[0] == "[" else -1
            if depth == 0:
                header = header[match.end() :].strip()
                break
        else:
            return header
    return header


def _is_obsolete(header: str) -> bool:
    attributes = header.strip().removesuffix(_without_attributes(header))
    return re.search(r"\bObsolete(Attribute)?\b", attributes) is not None


def _plain(type_name: str) -> str:
    """A type without namespaces and blanks."""
    return re.sub(r"(?:\w+\.)+(\w)", r"\1", re.sub(r"\s+", "", type_name).removeprefix("global::"))


def _parameter_types(text: str) -> list[str]:
    parameters: list[str] = []
    depth = start = 0
    for place, letter in enumerate(f"{text},"):
        depth += (letter in "<([{") - (letter in ">)]}")
        if letter == "," and depth == 0:
            parameters.append(text[start:place])
            start = place + 1
    types = []
    for parameter in parameters:
        words = _without_attributes(parameter.partition("=")[0]).split()
        if not words:
            continue
        reference = "ref " if words[0] in {"ref", "out", "in"} else ""
        while words[0] in {"ref", "out", "in", "params", "this", "readonly"}:
            words.pop(0)
        types.append(reference + _plain(" ".join(words[:-1])))
    return types
