"""Write the tables of rules and clauses in ``check.md`` anew: python docs/make_rules.py."""

from pathlib import Path

from garage2usd.checks import RULES
from garage2usd.profiles import PROFILE_NAMES, LengthRange, Steps, load_profile

PAGE = Path(__file__).with_name("check.md")
_MARKS = {name: (f"<!-- {name} -->\n", f"<!-- end of {name} -->\n") for name in ("rules", "clauses")}


def rules_table() -> str:
    """A line for each rule."""
    lines = ["| rule | asks that | reads |", "|---|---|---|"]
    for rule in RULES:
        reads = ", ".join(f"`{clause}`" for clause in rule.clauses) or rule.severity.value
        lines.append(f"| `{rule.name}` | {rule.asks} | {reads} |")
    return "\n".join(lines) + "\n"


def clauses_table() -> str:
    """A line for each clause, with its value in each shipped profile."""
    profiles = [dict(load_profile(name).clauses()) for name in PROFILE_NAMES]
    names = [name for name in type(load_profile(PROFILE_NAMES[0])).model_fields if name not in {"name", "title"}]
    lines = [f"| clause | {' | '.join(f'`{name}`' for name in PROFILE_NAMES)} |", "|---|" + "---|" * len(PROFILE_NAMES)]
    for name in names:
        values = " | ".join(_value(profile.get(name)) for profile in profiles)
        lines.append(f"| `{name}` | {values} |")
    return "\n".join(lines) + "\n"


def _value(clause: object) -> str:
    if clause is None:
        return ""
    if isinstance(clause, Steps):
        steps = ", ".join(f"{number} to {end}" for end, number in clause.steps)
        above = f"{clause.above}" if clause.above is not None else f"{clause.above_percent:g} %"
        return f"{steps}, then {above}"
    if isinstance(clause, LengthRange):
        return f"{clause.least:g} to {clause.most:g} {clause.unit}"
    severity = "" if clause.severity.value == "error" else f", {clause.severity.value}"
    unit = "" if clause.unit == "count" else f" {clause.unit}"
    return f"{clause.value:g}{unit} ({clause.confidence.value}{severity})"


def written(page: str) -> str:
    """The page with both tables as they are now."""
    for name, table in (("rules", rules_table()), ("clauses", clauses_table())):
        begin, end = _MARKS[name]
        before, _, rest = page.partition(begin)
        _, _, after = rest.partition(end)
        page = f"{before}{begin}{table}{end}{after}"
    return page


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
