"""Upload the files of a release one by one, and say which are published: ``python release/upload.py DIST INDEX``.

INDEX is the address under which pip finds packages. The index is asked first: a file that it has with the same digest
is left out, so that a run after a failure goes on where that ended. A file with another digest there stops the run
before anything is uploaded, because an index takes each name only once. ``twine`` uploads, and finds credentials as it
does elsewhere. The source distribution goes last, and only after all wheels: pip would compile it on systems whose
wheel is missing. Run it with ``build/release/bin/python``. The exit code is 1 where a file is not published in the end.
"""
# ruff: noqa: S310, S603 - twine is run, and the index that the user names is read

import argparse
import hashlib
import json
import re
import subprocess
import sys
import time
import urllib.error
import urllib.parse
import urllib.request
from collections.abc import Callable, Sequence
from html.parser import HTMLParser
from pathlib import Path

PACKAGE = "garage2usd"
_ACCEPTED = "application/vnd.pypi.simple.v1+json, application/vnd.pypi.simple.v1+html;q=0.5, text/html;q=0.1"
_ATTEMPTS = 3
_FIRST_WAIT_S = 5.0
_INDEX_DELAY_S = 60.0
"""Time after which an index shows what was uploaded, at most."""

_NOT_ASKED = "not asked for"
Upload = Callable[[Path], str]
"""Uploads a file; returns the reason of a failure, empty if there was none."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Upload what is missing; the exit code is 1 where a file is not published in the end."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("dist", type=Path, help="the folder of wheels and source distribution")
    parser.add_argument("index", help="the index's address, as pip's --index-url has it")
    parser.add_argument("--upload-to", metavar="URL", help="the address for uploads; left out, twine's own")
    parser.add_argument("--status", action="store_true", help="upload nothing, say what is published")
    asked = parser.parse_args(arguments)
    files = [*sorted(asked.dist.glob(f"{PACKAGE}-*.whl")), *sorted(asked.dist.glob(f"{PACKAGE}-*.tar.gz"))]
    if not files:
        parser.error(f"{asked.dist} has no files of {PACKAGE}")
    try:
        return publish(files, asked.index, (lambda _: _NOT_ASKED) if asked.status else twine(asked.upload_to))
    except OSError as error:
        print(f"{asked.index} does not answer: {error}")
        return 1


def publish(files: Sequence[Path], index: str, upload: Upload, *, wait_s: float = _FIRST_WAIT_S) -> int:
    """Upload the files that an index lacks, in the order given, a source distribution after all wheels alone.

    Parameters
    ----------
    files
        Wheels, then the source distribution.
    index
        Address of the index.
    upload
        Uploads a file.
    wait_s
        Seconds before the second attempt at a file; twice as long before each further one.

    Returns
    -------
    int
        0 if the index has all files in the end, else 1.

    Raises
    ------
    OSError
        If the index does not answer.
    """
    published = files_at(index)
    digests = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    others = [name for name, digest in digests.items() if published.get(name, digest) not in {digest, ""}]
    if others:
        print(*(f"{name}: PUBLISHED WITH OTHER CONTENT" for name in others), sep="\n")
        print("nothing was uploaded; a published file cannot be replaced, so give the release a new version")
        return 1
    reasons: dict[str, str] = {}
    sent = []
    for path in files:
        if path.name in published:
            continue
        if path.suffix == ".gz" and reasons:
            reasons[path.name] = "waits until all wheels are published"
        elif reason := _persistently(upload, path, wait_s):
            reasons[path.name] = reason
        else:
            sent.append(path.name)
    if sent:
        published = _after_delay(index, sent)
    for name in digests:
        said = (
            "published" if name in published else f"NOT PUBLISHED ({reasons.get(name, 'the index does not show it')})"
        )
        print(f"{name}: {said}{' now' if name in published and name in sent else ''}")
    missing = [name for name in digests if name not in published]
    print(f"{len(files) - len(missing)} of {len(files)} files are published")
    if missing:
        print("run this again: it uploads only what is missing")
    return int(bool(missing))


def twine(url: str | None) -> Upload:
    """Return a function that uploads a file with ``twine``, to its own index if no address is given."""

    def upload(path: Path) -> str:
        command = [sys.executable, "-m", "twine", "upload", "--non-interactive", "--disable-progress-bar"]
        command += [] if url is None else ["--repository-url", url]
        run = subprocess.run([*command, str(path)], capture_output=True, text=True, encoding="utf-8", check=False)
        lines = [line.strip() for line in f"{run.stdout}\n{run.stderr}".splitlines() if line.strip()]
        return "" if run.returncode == 0 else lines[-1] if lines else f"twine ended with exit code {run.returncode}"

    return upload


def files_at(index: str) -> dict[str, str]:
    """Read which files of the package an index has, in either form of the simple API.

    Returns
    -------
    dict
        By file name, the SHA-256 digest; empty where the index tells none.

    Raises
    ------
    OSError
        If the index does not answer.
    """
    request = urllib.request.Request(f"{index.rstrip('/')}/{PACKAGE}/", headers={"Accept": _ACCEPTED})
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            text, kind = answer.read().decode("utf-8"), answer.headers.get_content_type()
    except urllib.error.HTTPError as error:
        error.close()
        if error.code == 404:  # noqa: PLR2004 - a package that it has never seen
            return {}
        raise
    if kind.endswith("json"):
        return {file["filename"]: file.get("hashes", {}).get("sha256", "") for file in json.loads(text)["files"]}
    links = _Links()
    links.feed(text)
    found = {}
    for link in links.found:
        address = urllib.parse.urlparse(link)
        digest = re.search(r"sha256=([0-9a-f]{64})", address.fragment)
        found[urllib.parse.unquote(address.path.rpartition("/")[2])] = digest[1] if digest else ""
    return found


class _Links(HTMLParser):
    """Collects the addresses of links."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep the address of a link."""
        self.found += [value for name, value in attrs if tag == "a" and name == "href" and value]


def _persistently(upload: Upload, path: Path, wait_s: float) -> str:
    """Upload a file, again after a while where that fails; the reason of the last failure, empty if there is none."""
    for attempt in range(1, _ATTEMPTS + 1):
        reason = upload(path)
        if not reason or reason == _NOT_ASKED:
            return reason
        print(f"{path.name}: attempt {attempt} of {_ATTEMPTS} failed: {reason}", flush=True)
        if attempt < _ATTEMPTS:
            time.sleep(wait_s * 2 ** (attempt - 1))
    return reason


def _after_delay(index: str, sent: Sequence[str]) -> dict[str, str]:
    """Read an index until it shows all files that were sent, or for a minute."""
    end = time.monotonic() + _INDEX_DELAY_S
    while True:
        published = files_at(index)
        if all(name in published for name in sent) or time.monotonic() > end:
            return published
        time.sleep(2)


if __name__ == "__main__":
    sys.exit(main())
