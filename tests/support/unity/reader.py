"""The C# readers as one running process that answers with JSON."""

import json
import os
import shutil
import subprocess
import threading
from pathlib import Path

PACKAGE_VARIABLE = "GARAGE2USD_TEST_PACKAGE"
"""Names a copy of the package to test in place of the package: one with a planted fault."""

PACKAGE = Path(os.environ.get(PACKAGE_VARIABLE) or Path(__file__).parents[3] / "unity_importer")
STRICT = [] if PACKAGE_VARIABLE in os.environ else ["-warnaserror"]
"""A fault may well leave something unused."""


def missing() -> str | None:
    """What keeps this machine from compiling and running C#, if anything does."""
    absent = [program for program in ("mcs", "mono") if shutil.which(program) is None]
    return f"{' and '.join(absent)} not installed" if absent else None


def compile_program(folder: Path) -> Path:
    """``UsdDump.exe`` from the sources of the package, each warning an error."""
    program = folder / "UsdDump.exe"
    sources = sorted((PACKAGE / "Core").rglob("*.cs")) + sorted((PACKAGE / "Tools~" / "UsdDump").rglob("*.cs"))
    flags = [*STRICT, "-langversion:7.2", "-optimize+", "-r:System.Core"]
    command = ["mcs", *flags, f"-out:{program}", *map(str, sources)]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)
    return program


class Reader:
    """Asks the process for ``command`` of ``arguments``; one process for all files, as each start costs 0.2 s."""

    def __init__(self, program: Path) -> None:
        self.program = program
        self.process = None

    def ask(self, command: str, *arguments: object, cpu_limit_s: float | None = None) -> dict:
        """The answer to a command; ends the process where that takes more processor time than the limit."""
        return json.loads(self.answer(command, *arguments, cpu_limit_s=cpu_limit_s))

    def answer(self, command: str, *arguments: object, cpu_limit_s: float | None = None) -> str:
        """The answer as JSON."""
        if self.process is None:
            self.process = subprocess.Popen(
                ["mono", str(self.program), "batch"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                encoding="utf-8",
            )
        answered = threading.Event()
        if cpu_limit_s is not None:
            threading.Thread(target=self._watch, args=(answered, cpu_limit_s), daemon=True).start()
        self.process.stdin.write("\t".join([command, *map(str, arguments)]) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        answered.set()
        assert answer, f"the reader died of {command} {arguments}"
        return answer

    def _watch(self, answered: threading.Event, limit_s: float) -> None:
        # by processor time, as a busy machine is no fault of the reader's
        before_s = self._cpu_s()
        while not answered.wait(1.0):
            if self._cpu_s() - before_s > limit_s:
                self.process.kill()
                return

    def _cpu_s(self) -> float:
        user, system = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()[11:13]
        return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")

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
