"""Scalars of a run, from the files that it leaves: a module a family. A measure is a function of the
folder of results, the level and options of table.json. Its docstring says on docs/verification.md what
it is. Here is what needs the standard library only; the families need NumPy and h5py."""
import ast
import importlib
import math
from pathlib import Path


def named(measure):
    """The function that "family.name" means."""
    family, name = measure.split(".")
    return getattr(importlib.import_module(f"measures.{family}"), name)


def words(measure):
    """What that function measures, without importing it."""
    family, name = measure.split(".")
    functions = ast.parse((Path(__file__).parent / f"{family}.py").read_text()).body
    return next(ast.get_docstring(function) for function in functions
                if isinstance(function, ast.FunctionDef) and function.name == name)


def number(formula, **values):
    """Of a formula in Python's words, such as 2/sqrt(3)*n."""
    return eval(formula, {"__builtins__": {}, "round": round} | vars(math) | values)


def error(case, level, folder):
    """The measure of a run over its exact value, less one; where that is 0, the measure itself."""
    value = named(case["measure"])(folder, level, **case.get("options", {}))
    exact = number(case["exact"], n=level)
    return float(value / exact - 1 if exact else value)
