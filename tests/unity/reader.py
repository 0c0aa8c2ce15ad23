"""The C# readers as one running process that answers with JSON."""

import json
import shutil
import subprocess
import threading
from pathlib import Path

PACKAGE = Path(__file__).parents[2] / "unity_importer"
PROGRAM_VARIABLE = "GARAGE2USD_TEST_USD_DUMP"
"""Names a compiled program for the tests to use instead of compiling the sources: one with a planted fault."""


def missing() -> str | None:
    """What keeps this machine from compiling and running C#, if anything does."""
    absent = [program for program in ("mcs", "mono") if shutil.which(program) is None]
    return f"{' and '.join(absent)} not installed" if absent else None


def compile_program(folder: Path, package: Path = PACKAGE, *, flags: tuple[str, ...] = ("-warnaserror",)) -> Path:
    """``UsdDump.exe`` from the sources of the package, each warning an error where not told otherwise."""
    program = folder / "UsdDump.exe"
    sources = sorted((package / "Core").rglob("*.cs")) + sorted((package / "Tools~" / "UsdDump").rglob("*.cs"))
    command = ["mcs", *flags, "-langversion:7.2", "-optimize+", "-r:System.Core", f"-out:{program}", *map(str, sources)]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)
    return program


class Reader:
    """Asks the process for ``command`` of ``arguments``; one process for all files, as each start costs 0.2 s."""

    def __init__(self, program: Path) -> None:
        self.program = program
        self.process = None

    def ask(self, command: str, *arguments: object, timeout_s: float | None = None) -> dict:
        """The answer to a command; ends the process where that takes longer than the time given."""
        if self.process is None:
            self.process = subprocess.Popen(
                ["mono", str(self.program), "batch"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                encoding="utf-8",
            )
        self.process.stdin.write("\t".join([command, *map(str, arguments)]) + "\n")
        self.process.stdin.flush()
        watch = None if timeout_s is None else threading.Timer(timeout_s, self.process.kill)
        if watch:
            watch.start()
        answer = self.process.stdout.readline()
        if watch:
            watch.cancel()
        assert answer, f"the reader died of {command} {arguments}"
        return json.loads(answer)

    def forget_peak(self) -> None:
        """Let the memory that the process holds now be its peak."""
        if self.process is not None:
            Path(f"/proc/{self.process.pid}/clear_refs").write_text("5")

    def peak_mb(self) -> float:
        """Most memory that the process held since ``forget_peak``."""
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.split("VmHWM:")[1].split()[0]) / 1024

    def close(self) -> None:
        if self.process is not None:
            self.process.stdin.close()
            self.process.stdout.close()
            self.process.wait(timeout=20)
            self.process = None
