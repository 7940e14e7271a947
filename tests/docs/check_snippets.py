"""Runs every fenced code block of one document, so that what the documentation shows is true.

Blocks run in order, in one scratch copy of the repository per document, with the built program first in PATH.

    sh      run with `sh -e`, which must succeed. A block that calls `./run` or a CMake preset would build the project
            again: there only the names of the sub-commands and presets are checked.
    python  run with this interpreter; must succeed.
    cpp     a whole program: compiled without warnings, linked to libstrutt and run; must return 0.
    toml    a whole scene: `strutt chart FILE --dry-run` if it has [chart], else `strutt stability FILE --dry-run`.
    cmake   every line stands in tests/consumer/CMakeLists.txt, which is built against an installation.
    text, console   right after an sh, python or cpp block: its standard output, where `...` stands for anything.
                    Elsewhere: not checked.

Any other language, and a fence without one, is an error.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def blocks(document):
    """Yields (line number, language, text, whether only blank lines separate it from the block before)."""
    language, adjacent = None, False
    for number, line in enumerate(document.read_text(encoding="utf-8").splitlines(), 1):
        fence = re.fullmatch(r"(\s*)(`{3,}|~{3,})\s*(\S*).*", line)
        if language is None:
            if fence:
                indent, mark, language = fence[1], fence[2], fence[3]
                first, body = number, []
            elif line.strip():
                adjacent = False
        elif fence and fence[2].startswith(mark) and not fence[3]:
            yield first, language, "".join(body), adjacent
            language, adjacent = None, True
        else:
            body.append(line.removeprefix(indent) + "\n")
    if language is not None:
        raise SystemExit(f"{document}:{first}: the block is not closed")


class Checker:
    def __init__(self, options, scratch):
        self.options = options
        self.scratch = scratch
        shutil.copytree(options.root, scratch, dirs_exist_ok=True,
                        ignore=lambda folder, names: {".git", "build", "out"} & set(names))
        self.environment = {**os.environ, "PATH": f"{options.program.parent}:/usr/bin:/bin", "LC_ALL": "C.UTF-8"}

    def run(self, *command):
        done = subprocess.run(command, cwd=self.scratch, env=self.environment, text=True, timeout=300,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        assert done.returncode == 0, f"exit code {done.returncode}\n{done.stdout}{done.stderr}"
        return done.stdout

    def file(self, suffix, text):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=self.scratch.parent))
        path = self.folder / f"snippet{suffix}"
        path.write_text(text, encoding="utf-8")
        return str(path)

    def names_exist(self, text):
        """The sub-commands of ./run and the presets that the block names are real."""
        known = re.findall(r"^  (\w+) .*?  ", self.run("./run", "help"), re.MULTILINE)
        for name in re.findall(r"\./run[ \t]+(\w+)", text):
            assert name in known, f"./run has no {name}"
        presets = json.loads((self.scratch / "CMakePresets.json").read_text())["configurePresets"]
        for name in re.findall(r"--preset[= ](\w+)", text):
            assert name in [preset["name"] for preset in presets], f"there is no preset {name}"

    def check_sh(self, text):
        if re.search(r"(^|\s)\./run\b|--preset\b", text):
            self.names_exist(text)
            return None
        return self.run("sh", "-ec", text)

    def check_python(self, text):
        return self.run(sys.executable, "-c", text)

    def check_cpp(self, text):
        program = self.file(".cpp", text)
        library = self.options.library
        self.run(*self.options.compile, f"-I{self.options.root}/include", program, "-o", program[:-4], str(library),
                 f"-Wl,-rpath,{library.parent}")
        return self.run(program[:-4])

    def check_toml(self, text):
        command = "chart" if re.search(r"^\[chart\]", text, re.MULTILINE) else "stability"
        self.run(str(self.options.program), command, self.file(".toml", text), "--dry-run")

    def check_cmake(self, text):
        real = (self.scratch / "tests/consumer/CMakeLists.txt").read_text().splitlines()
        for line in filter(str.strip, text.splitlines()):
            assert line in real, f"not in tests/consumer/CMakeLists.txt: {line}"

    def check_output(self, expected, actual):
        pattern = re.escape(expected.rstrip()).replace(r"\.\.\.", r"[\s\S]*?")
        trimmed = "\n".join(line.rstrip() for line in actual.splitlines()).rstrip()
        assert re.fullmatch(pattern, trimmed), f"the output is\n{actual}"

    def check(self, language, text, output):
        """Returns what the block printed, or None."""
        if language in ("text", "console"):
            if output is not None:
                self.check_output(text, output)
            return None
        assert language in ("sh", "python", "cpp", "toml", "cmake"), f"no rule for blocks of language '{language}'"
        return getattr(self, f"check_{language}")(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("document", type=pathlib.Path, help="relative to the root")
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--program", type=pathlib.Path, required=True)
    parser.add_argument("--library", type=pathlib.Path, required=True)
    parser.add_argument("--compile", nargs=argparse.REMAINDER, required=True, help="compiler and flags; the last option")
    options = parser.parse_args()

    count, failures, output = 0, 0, None
    with tempfile.TemporaryDirectory() as folder:
        checker = Checker(options, pathlib.Path(folder) / "strutt")
        for line, language, text, adjacent in blocks(options.root / options.document):
            count += 1
            try:
                output = checker.check(language, text, output if adjacent else None)
            except (AssertionError, subprocess.TimeoutExpired) as error:
                failures += 1
                print(f"{options.document}:{line}: {language} block: {error}")
                output = None
    print(f"{options.document}: {count} blocks, {failures} failures")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
