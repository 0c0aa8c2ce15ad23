"""The command ``garage2usd check``."""

import json
import sys
from collections import Counter
from pathlib import Path

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, profile_option
from garage2usd.common.usd_messages import usd_messages

_MOST_OF_A_RULE = 10


@click.command(short_help="Check a stage, a report or a plan against a standard.")
@click.argument("path", type=INPUT_FILE)
@profile_option("The standard to check against, in place of the one that it was designed to")
@click.option("--json", "as_json", is_flag=True, help="Print all findings as JSON; the table has ten of a rule.")
@click.pass_context
def check(ctx: click.Context, *, path: Path, profile: str | None, as_json: bool) -> None:
    """Check a stage, a report or a plan against a standard.

    PATH is a stage (including one edited in other tools), the report of a build, a configuration with a structure, or
    a structure as text, JSON, .npy or .npz. The exit code is 1 if there are errors; warnings and remarks do not count.
    Clauses that cannot be checked are listed with the reason.

    \b
    Examples:
      garage2usd check garage.usdz
      garage2usd check garage_report.json --profile us-ada --json
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd import checks  # noqa: PLC0415 - keeps --help instant
    from garage2usd.garage_sources import read_built  # noqa: PLC0415
    from garage2usd.profiles import load_profile  # noqa: PLC0415

    given = None if profile is None else load_profile(profile)
    with Bars(sys.stderr) as progress:
        source = read_built(path, profile=given, progress=progress)
        against, findings, not_checked = source.profile, source.findings(progress=progress), source.not_checked()
    usd_messages()  # discard them, as the findings say the same
    counts = Counter(finding.severity.value for finding in findings)
    if as_json:
        document = {
            "path": str(path),
            "checked_against": against.name,
            "clauses_checked": checks.clauses_checked(against, not_checked),
            "counts": {severity.value: counts[severity.value] for severity in checks.Severity},
            "findings": checks.as_json(findings),
            "not_checked": [{"clause": clause, "reason": reason} for clause, reason in not_checked.items()],
        }
        click.echo(json.dumps(document, indent=1))
    else:
        for line in checks.as_table(findings, most=_MOST_OF_A_RULE):
            click.echo(line)
        for line in checks.not_checked_lines(not_checked):
            click.echo(line)
        click.echo(checks.clauses_in_words(checks.clauses_checked(against, not_checked), against.name))
        figures = ", ".join(f"{counts[severity.value]} {severity.value}" for severity in checks.Severity)
        click.echo(f"checked against {against.name}: {figures}")
    if counts["error"]:
        ctx.exit(1)
