"""Every public name is documented and typed; errors travel."""

import ast
import inspect
import pickle
from pathlib import Path

import pytest
from conftest import Command, case

import hexbench
from hexbench import _native


def _public(thing: object) -> set[str]:
    return {name for name in dir(thing) if not name.startswith("_")}


def _stub() -> dict[str, set[str]]:
    """Names of the stub, and of what is inside each."""
    tree = ast.parse(Path(_native.__file__).with_name("_native.pyi").read_text())
    named = {}
    for node in tree.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            inside = node.body if isinstance(node, ast.ClassDef) else []
            named[node.name] = {n.name for n in inside if isinstance(n, ast.FunctionDef)}
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            named[node.target.id] = set()
    return named


def test_the_stub_has_every_name_of_the_native_module_and_no_other() -> None:
    stub = _stub()
    assert set(stub) == _public(_native) | {"__version__"}
    for name, inside in stub.items():
        thing = getattr(_native, name)
        if inspect.isclass(thing):
            assert {n for n in inside if not n.startswith("_")} == _public(thing), name


def test_every_public_name_has_a_docstring() -> None:
    bare = []
    for module in (hexbench, _native):
        names = hexbench.__all__ if module is hexbench else sorted(_public(module))
        for name in names:
            thing = getattr(module, name)
            if isinstance(thing, str):
                continue
            inside = (
                [(f"{name}.{n}", inspect.getattr_static(thing, n)) for n in _public(thing)] if inspect.isclass(thing) else []
            )
            fields = getattr(thing, "__dataclass_fields__", {})
            members = [(n, m) for n, m in inside if callable(m) or isinstance(m, property) or inspect.isdatadescriptor(m)]
            own = [(n, m) for n, m in members if n.split(".")[1] not in (*fields, "args", "add_note", "with_traceback")]
            os_error = {"errno", "strerror", "filename", "filename2", "characters_written"}
            own = [(n, m) for n, m in own if n.split(".")[1] not in os_error]
            bare += [n for n, member in [(name, thing), *own] if not inspect.getdoc(member)]
    assert not bare, bare


def test_what_is_exported_is_what_is_there() -> None:
    modules = {n for n, thing in vars(hexbench).items() if inspect.ismodule(thing)}
    assert _public(hexbench) - modules == set(hexbench.__all__) - {"__version__", "blocks", "commands"}
    assert hexbench.__all__ == sorted(hexbench.__all__)


def test_the_version_is_that_of_the_command(command: Command) -> None:
    assert command("--version").stdout.split() == ["hexbench", hexbench.__version__]


@pytest.mark.parametrize("kind", ["BadInput", "UsageError", "NotDetermined", "InputOutput", "HexbenchError"])
def test_errors_travel_between_processes(kind: str) -> None:
    error = getattr(hexbench, kind)("data: row 3: wrong", "Do this.")
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) == "data: row 3: wrong\n  next: Do this."
    assert (again.message, again.next_step) == ("data: row 3: wrong", "Do this.")


def test_errors_have_the_text_and_the_kind_of_the_command(command: Command, tmp_path: Path) -> None:
    hexapod, data, _ = case("paper-protocol")
    absolute = case("absolute-pitch")[2]
    campaign = hexbench.load(hexapod, data)
    (tmp_path / "model.toml").write_text("format = 3")
    calls = [
        (2, hexbench.UsageError, lambda: hexbench.fit(campaign, ["leg-backlsh"]), ["fit", hexapod, data, "--add", "leg-backlsh"]),
        (3, hexbench.BadInput, lambda: hexbench.diagnose(campaign, holdout=absolute), ["diagnose", hexapod, data, "--holdout", absolute]),
        (3, hexbench.BadInput, lambda: hexbench.diagnose(campaign, exclude=[1]), ["diagnose", hexapod, data, "--exclude", "1"]),
        (3, hexbench.BadInput, lambda: hexbench.Model.load(tmp_path / "model.toml"), ["compare", hexapod, data, "--model", tmp_path / "model.toml"]),
        (4, hexbench.NotDetermined, lambda: hexbench.fit(campaign, ["leg-asymmetry"]), ["fit", hexapod, data, "--add", "leg-asymmetry"]),
        (5, hexbench.InputOutput, lambda: hexbench.load(hexapod, tmp_path / "none.csv"), ["diagnose", hexapod, tmp_path / "none.csv"]),
        (5, hexbench.InputOutput, lambda: hexbench.fit(campaign, terms=[tmp_path / "t.toml"]), ["fit", hexapod, data, "--term", tmp_path / "t.toml"]),
        (2, hexbench.UsageError, lambda: hexbench.fit(campaign, ["creep"], estimator="paper"), ["fit", hexapod, data, "--add", "creep", "--estimator", "paper"]),
    ]  # fmt: skip
    for code, kind, call, words in calls:
        with pytest.raises(kind) as raised:
            call()
        assert f"error: {raised.value}\n" == command(*words, code=code).stderr, words
    assert issubclass(hexbench.BadInput, ValueError) and issubclass(hexbench.UsageError, ValueError)
    assert issubclass(hexbench.InputOutput, OSError)
