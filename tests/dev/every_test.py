#!/usr/bin/env python3
"""Every test of the repository is run by something: every_test.py [ROOT]

A file NAME_test.py is named by a CMakeLists.txt or by a script; if they name its classes one by one, they name all of
them. A file NAME_test.cpp is named by the CMakeLists.txt of its folder, or is in a folder that
tests/unit/CMakeLists.txt names, which runs all that are in it.
"""
import ast
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def read(path):
    return path.read_text(encoding="utf-8") if path.exists() else ""


def bases_of(node):
    return [base.id if isinstance(base, ast.Name) else getattr(base, "attr", "") for base in node.bases]


def classes_of(text):
    """Of each class: its own tests, and the classes that it is derived from."""
    found = {}
    for node in ast.parse(text).body:
        if isinstance(node, ast.ClassDef):
            tests = [f.name for f in node.body if isinstance(f, ast.FunctionDef) and f.name.startswith("test")]
            found[node.name] = (tests, bases_of(node))
    return found


def has(text, word):
    return re.search(rf"(?<![\w.]){re.escape(word)}(?![\w])", text) is not None


def runs(name, classes, text):
    """Whether the class runs, by itself or as the base of another one."""
    return has(text, name) or any(name in bases and runs(other, classes, text) for other, (_, bases) in classes.items())


def unrun_of_file(path, text):
    if not has(text, path.name):
        return [f"{path.name}: nothing runs it"]
    classes = classes_of(read(path))
    if not any(tests and has(text, name) for name, (tests, _) in classes.items()):
        return []  # all at once
    missing = [f"{path.name}: nothing runs the class {name}" for name, (tests, _) in classes.items() if tests and not runs(name, classes, text)]
    for name, (tests, _) in classes.items():
        if f"{name}.test_$" in text:  # one by one
            missing += [f"{path.name}: nothing runs {name}.{test}" for test in tests if not has(text, test.removeprefix("test_"))]
    return missing


def unrun_python(root):
    scripts = [*root.glob("tests/**/CMakeLists.txt"), *root.glob("tools/**/CMakeLists.txt"), *root.glob("tools/dev/*.sh"), *root.glob("tests/*/in_uml.py")]
    everywhere = "\n".join(read(path) for path in sorted(scripts))
    missing = []
    for path in sorted([*root.glob("tests/**/*_test.py"), *root.glob("tools/**/*_test.py")]):
        own = read(path.parent / "CMakeLists.txt")
        lines = "\n".join(line for line in everywhere.splitlines() if has(line, path.name))
        missing += unrun_of_file(path, own if has(own, path.name) else lines)
    return missing


def unrun_cpp(root):
    tests, units = root / "tests", read(root / "tests/unit/CMakeLists.txt")
    missing = []
    for path in sorted(root.glob("tests/**/*_test.cpp")):
        folder = path.parent.relative_to(tests)
        name = folder.relative_to("unit") if folder.is_relative_to("unit") else Path("..") / folder
        own = read(path.parent / "CMakeLists.txt")
        if not has(units, name.as_posix()) and not has(own, path.name) and "FOLDERS ." not in own:
            missing.append(f"{path.relative_to(root).as_posix()}: nothing runs it")
    return missing


def unrun(root):
    return unrun_python(root) + unrun_cpp(root)


class Every(unittest.TestCase):
    def test_of_the_repository(self):
        self.assertEqual(unrun(ROOT), [])

    def test_what_is_missing_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name in ("tests/a", "tests/unit/ir", "tests/unit/left"):
                (root / name).mkdir(parents=True)
            (root / "tests/a/CMakeLists.txt").write_text("foreach(class One Third) a_test.py ${class}\nwhole_test.py\ncases_test.py Cases.test_${case} x\n")
            (root / "tests/a/a_test.py").write_text("class One(T):\n  def test_x(self): pass\nclass Base(T):\n  def test_y(self): pass\n"
                                                    "class Two(T):\n  def test_x(self): pass\nclass Third(Base): pass\n")
            (root / "tests/a/whole_test.py").write_text("class Any(T):\n  def test_x(self): pass\n")
            (root / "tests/a/cases_test.py").write_text("class Cases(T):\n  def test_x(self): pass\n  def test_z(self): pass\n")
            (root / "tests/a/lost_test.py").write_text("class Any(T):\n  def test_x(self): pass\n")
            (root / "tests/unit/CMakeLists.txt").write_text("rung_add_test(ir FOLDERS ir)\n")
            (root / "tests/unit/ir/b_test.cpp").write_text("")
            (root / "tests/unit/left/c_test.cpp").write_text("")
            self.assertEqual(unrun(root), ["a_test.py: nothing runs the class Two", "cases_test.py: nothing runs Cases.test_z",
                                           "lost_test.py: nothing runs it", "tests/unit/left/c_test.cpp: nothing runs it"])


if __name__ == "__main__":
    unittest.main()
