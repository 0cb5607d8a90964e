"""States of a series in arrays: a cover or a mesh, and fields on it."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from numpy.typing import ArrayLike

from ._blocks import Block
from ._cover import Cover
from ._facts import Crack
from ._functions import Function
from ._mesh import Mesh
from ._units import Floats

#: A code's own evaluation: a function of x and y, or points and values.
Reference = Callable[[Floats, Floats], ArrayLike] | tuple[ArrayLike, ArrayLike]


class Sampled(NamedTuple):
    """Points and a library's own values there, for `Coefficients.verify`."""

    points: Floats
    values: Floats


@dataclass(frozen=True, eq=False)
class Coefficients:
    """A field: on each patch a sum of function × polynomial, by the coefficients of the polynomials.

    A polynomial of degree d, at most 8, has m = (d + 1)(d + 2)/2 coefficients of 1, ξ, η, ξ², ξη, η², ξ³, … with
    ξ = (p − origin) / scale of the cover, or ξ of the mesh; `ppum.basis` converts those of other bases. On meshes it may
    be a tensor product, with m = (d + 1)² coefficients of 1, ξ, …, ξ^d, η, ξη, …

    Attributes:
        name: Name of the field. With an equation the first field is ``displacement`` or ``potential``.
        blocks: The coefficients by the name of the function, ``one`` for 1 or a name of `State.functions`. An array of
            shape (n, m), with several components (n, m, c), for all n patches; a list with an array (m,) or (m, c) or
            None for each patch; or a dictionary of such arrays by the number of the patch.
        components: Names; by default ``ux``, ``uy`` of ``displacement``, else `name`, with 0, 1, … if there are several.
        unit: For labels.
        exact: Formulas of x and y of the exact solution, one per component.
        verify: Reference values: a function of arrays x and y with the shape (k,) or (k, c), or points (k, 2) and values.
        space: Polynomials on meshes, of all functions or by name: ``shape``, tensor products on squares alone; ``total``
            degree; or ``tensor``.

    Example:
        >>> cover = ppum.build.Cover.uniform([(0, 0), (2, 1)], cells=(2, 1))
        >>> c = np.column_stack([cover.center[:, 0], cover.half[:, 0], np.zeros(2)])
        >>> made = ppum.build.dataset(ppum.build.State(cover, ppum.build.Coefficients("u", {"one": c}, verify=lambda x, y: x)))
        >>> float(made.field.at(1.25, 0.5).u)
        1.25
    """

    name: str
    blocks: Mapping[str, Block]
    components: Sequence[str] | None = None
    unit: str = ""
    exact: Sequence[str] = ()
    verify: Reference | None = None
    space: str | Mapping[str, str | Sequence[str]] = "shape"


@dataclass(frozen=True, eq=False)
class State:
    """One step of a series: a cover or a mesh, its fields, the cracks and functions that they need.

    Attributes:
        cover: The partition of unity, or the elements.
        fields: One field or several; images and quantities are of the first.
        cracks: Points of each crack, shape (k, 2), or `ppum.Crack`, which may have arcs. By default an end on the border of the domain or of a
            hole is a ``mouth``, one on another crack a ``junction``, any other a ``tip``; values do not depend on it.
        functions: Functions beside ``one`` by name: `Jump`, `Component`, `Level`, `Formula` or the text of a formula.
        attributes: Values for each patch by name, shape (n,), NaN for none.
        load: Load factor or time.
    """

    cover: Cover | Mesh
    fields: Coefficients | Sequence[Coefficients]
    cracks: Sequence[ArrayLike | Crack] = ()
    functions: Mapping[str, Function] = field(default_factory=dict)
    attributes: Mapping[str, ArrayLike] = field(default_factory=dict)
    load: float = 1.0
