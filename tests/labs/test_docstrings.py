"""Public docstrings by numpydoc's own validator."""

import inspect

import koebe
import pytest
from numpydoc.validate import validate

CLASSES = [name for name in koebe.__all__ if inspect.isclass(getattr(koebe, name))]
METHODS = [f"{name}.{key}" for name in CLASSES for key, one in vars(getattr(koebe, name)).items()
           if inspect.isfunction(one) and not key.startswith("_")]  # fmt: skip
LEFT_OUT = {"ES01", "SA01"}  # a longer summary, and a section See Also


@pytest.mark.parametrize("name", [name for name in koebe.__all__ if callable(getattr(koebe, name))] + METHODS)
def test_the_validator_finds_nothing(name):
    # A method's example is its class's.
    left_out = LEFT_OUT | ({"EX01"} if "." in name else set())
    assert [error for error in validate(f"koebe.{name}")["errors"] if error[0] not in left_out] == []
