"""Views that show the same place."""

from contextlib import ExitStack
from typing import Any


def link(one: Any, other: Any, traits: tuple[str, ...] = ("center", "width")) -> ExitStack:
    """Link two views, so that they show the same place.

    Args:
        one: A view, which gives its values first.
        other: Another view, of the same or of another dataset.
        traits: Names of the linked traits; centers to the digits of double precision.

    Returns:
        A handle, whose `close()` unlinks the views.

    Example:
        >>> left, right = ds.view("ux"), ds.view("uy")
        >>> links = ppum.link(left, right)
        >>> left.center = (0.25, 0.5)
        >>> right.center
        (0.25, 0.5)
        >>> links.close()
    """
    import traitlets

    # of the first alone its page decides what fits
    other._is_whole = False
    links = ExitStack()
    for name in traits:
        links.callback(traitlets.link((one, name), (other, name)).unlink)
    return links
