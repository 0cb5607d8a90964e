"""What all that is done with a field begins with."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _core

if TYPE_CHECKING:
    from .dataset import Dataset, Step

__all__ = ["FieldCore"]


class FieldCore:
    """A field of a step of a dataset, of which nothing is asked yet."""

    dataset: Dataset
    _number: int
    _subject: Mapping[str, Any]
    _core: _core.Field

    @property
    def step(self) -> Step:
        """The step that the field belongs to."""
        return self.dataset.steps[self._number]

    @cached_property
    def components(self) -> tuple[str, ...]:
        """Names of the components: ``ux``, ``uy``, or ``u``."""
        return tuple(self._core.components())
