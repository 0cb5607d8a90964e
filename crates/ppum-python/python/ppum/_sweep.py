"""Many problems: all combinations of parameters, on this machine or on a cluster, as one xarray dataset."""

import hashlib
import itertools
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._dataset import Dataset, open as open_dataset
from ._errors import PpumError, require
from ._problem import Problem, solve
from ._text import ProgressLine

#: What is kept of each tip, see `Tip`, with what plots write at axes.
TIPS = {
    "k1": "$K_{I}$", "k2": "$K_{II}$", "t_stress": "$T$", "j": "$J$", "g": "$G$", "growth_angle": "angle of growth",
    "error": "estimated error of $K$",
}  # fmt: skip
#: What is kept of each solution beside it.
PLAIN = ("energy", "unknowns", "patches", "warnings")

_Make = Callable[..., Problem | Mapping[str, Any]]
_Row = dict[str, Any]


def sweep(make: _Make, **parameters: Sequence[Any]) -> "Sweep":
    """Combine all values of parameters, each combination a problem.

    Args:
        make: Returns the problem for one value of each parameter, which it takes by name.
        parameters: The values of each, a list or an array.

    Example:
        >>> def make(length, load):
        ...     return plate.crack((-0.8, -1.2), (-0.8 + length, -1.2)).boundary("left", traction=(load, 0))
        >>> cases = ppum.sweep(make, length=[0.2, 0.4], load=[0.0, 1.0])
        >>> result = cases.run()
        >>> result.k1.dims, result.k1.shape
        (('length', 'load', 'tip'), (2, 2, 4))
        >>> result.status.values.tolist()[0]
        ['', 'SolveError: ...']
    """
    return Sweep(make, parameters)


class Sweep:
    """All combinations of parameters; made by `ppum.sweep`."""

    def __init__(self, make: _Make, parameters: Mapping[str, Sequence[Any]]) -> None:
        if not parameters:
            raise ValueError("a sweep has a parameter or more")
        self._make = make
        self._values = {name: list(values) for name, values in parameters.items()}
        if taken := {"tip", *TIPS, *PLAIN, "x", "y", "status"} & set(parameters):
            raise ValueError(f"results are called {', '.join(sorted(taken))}; name parameters otherwise")

    def __len__(self) -> int:
        return int(np.prod([len(values) for values in self._values.values()]))

    def __repr__(self) -> str:
        names = " x ".join(f"{name} {len(values)}" for name, values in self._values.items())
        return f"<ppum.Sweep {names}>"

    def problems(self) -> Iterator[tuple[dict[str, Any], Problem]]:
        """Yield each combination with its problem, the last parameter running fastest."""
        for chosen in self._combinations():
            yield chosen, self._problem(chosen)

    def _combinations(self) -> Iterator[dict[str, Any]]:
        for values in itertools.product(*self._values.values()):
            yield dict(zip(self._values, values, strict=True))

    def _problem(self, chosen: dict[str, Any]) -> Problem:
        problem = self._make(**chosen)
        return problem if isinstance(problem, Problem) else Problem.from_dict(problem)

    def run(
        self,
        client: Any = None,
        *,
        save: str | os.PathLike[str] | None = None,
        threads: int | None = None,
        progress: bool | Callable[[int, int], object] = False,
    ) -> Any:
        """Solve all problems.

        Numbers come back, not datasets. A problem that cannot be made or solved, or whose worker dies again and again, has
        NaN, and the reason in `status`, which is empty otherwise.

        Args:
            client: A `dask.distributed.Client`, whose workers solve; by default this process, which on one machine is as fast.
            save: A folder for datasets, the same for all workers. Problems whose datasets are there are not solved again.
            threads: Threads of each solution.
            progress: True for a line on standard error, or a function of how many are done and of all.

        Returns:
            An `xarray.Dataset` of energy, unknowns, patches, warnings and status over the parameters, and of k1, k2, t_stress, j,
            g, growth_angle, error and the place x, y also over `tip`; with symbols as `long_name`.

        Raises:
            Exception: No problem can be made; the error of the first combination.

        Example:
            >>> cases = ppum.sweep(lambda order: plate.discretization(level=2, order=order), order=[1, 2])
            >>> result = cases.run()
            >>> result.k1.sel(order=2, tip=1).attrs["long_name"], result.unknowns.values.tolist()[0] > 0
            ('$K_{I}$', True)
        """
        # before hours of work, not after
        xarray = require("xarray", "xarray", "results of sweeps")
        folder = None if save is None else Path(save).absolute()
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
        made, rows = self._made()
        tell = ProgressLine().solved if progress is True else progress or (lambda done, total: None)
        for done, (k, row) in enumerate(_rows_of(made, client, folder, threads), 1 + len(rows) - len(made)):
            rows[k] = row
            tell(done, len(rows))
        return self._gathered(rows, xarray)

    def _made(self) -> tuple[dict[int, Problem], list[_Row]]:
        """Return the problems by the numbers of their combinations, and the rows of those that cannot be made."""
        made: dict[int, Problem] = {}
        errors: dict[int, Exception] = {}
        for k, chosen in enumerate(self._combinations()):
            try:
                made[k] = self._problem(chosen)
            except Exception as error:
                errors[k] = error
        if errors and not made:
            raise errors[0]
        return made, [_failed(errors[k]) if k in errors else {} for k in range(len(self))]

    def _gathered(self, rows: list[_Row], xarray: Any) -> Any:
        shape, dims = tuple(len(v) for v in self._values.values()), tuple(self._values)
        count = max((len(row.get("tips", ())) for row in rows), default=0)
        per_tip = np.full((len(rows), count, len(TIPS) + 2), np.nan)
        for k, row in enumerate(rows):
            if tips := row.get("tips"):
                per_tip[k, : len(tips)] = tips
        plain = {name: np.array([row.get(name, np.nan) for row in rows]).reshape(shape) for name in (*PLAIN, "status")}
        variables: dict[str, Any] = {name: (dims, values) for name, values in plain.items()}
        for n, name in enumerate((*TIPS, "x", "y")):
            words = {"long_name": TIPS[name]} if name in TIPS else {}
            words |= {"units": "rad"} if name == "growth_angle" else {}
            variables[name] = (*dims, "tip"), per_tip[..., n].reshape(*shape, count), words
        return xarray.Dataset(variables, {**self._values, "tip": np.arange(count)})


def _rows_of(
    problems: Mapping[int, Problem], client: Any, folder: Path | None, threads: int | None
) -> Iterator[tuple[int, _Row]]:
    """Yield the rows of problems by their numbers, here or from the workers of a client.

    Results are taken and released one by one: a worker that dies loses none.
    """
    if client is None:
        yield from ((k, _one(problem, folder, threads)) for k, problem in problems.items())
        return
    from distributed import as_completed

    numbers = {client.submit(_one, problem, folder, threads, pure=False): k for k, problem in problems.items()}
    for future in as_completed(list(numbers), raise_errors=False):
        error = future.exception() if future.status in ("error", "lost") else None
        yield numbers.pop(future), future.result() if error is None else _failed(error)
        future.release()


def _one(problem: Problem, folder: Path | None, threads: int | None) -> _Row:
    path = None if folder is None else folder / f"{_name(problem)}.h5"
    try:
        if path is not None and path.exists():
            return _row(open_dataset(path))
        dataset = solve(problem, threads=threads)
        if path is not None:
            dataset.save(path)
        return _row(dataset)
    except PpumError as error:
        return _failed(error)


def _name(problem: Problem) -> str:
    """Return the name of a problem's dataset, from the problem and the version that solves it."""
    text = f"{_core.VERSION}\n{problem._folder}\n{problem.to_toml()}"
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _row(dataset: Dataset) -> _Row:
    step = dataset.steps[-1]
    tips = [[*(getattr(tip, name) for name in TIPS), *tip.xy] for tip in step.tips]
    numbers = {"energy": step.history.get("energy", np.nan), "unknowns": step.unknowns, "patches": step.patches}
    return numbers | {"warnings": len(step.warnings), "tips": tips, "status": ""}


def _failed(error: BaseException) -> _Row:
    return {"status": f"{type(error).__name__}: {error}"}
