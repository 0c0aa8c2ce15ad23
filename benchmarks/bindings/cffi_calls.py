"""By cffi: the same calls in both of its modes."""

from typing import Any, NamedTuple


class Calls(NamedTuple):
    """The functions by one mode's `ffi` and `lib`."""

    ffi: Any
    lib: Any

    def packed(self, scene: Any) -> tuple[Any, list[Any]]:  # noqa: ANN401 - a named tuple
        """Pack the named tuple; the list keeps what it refers to alive."""
        held = [self.ffi.from_buffer("double[]", array) for array in scene]
        shapes, boxes, body = (
            [pointer, *array.shape] for pointer, array in zip(held, scene, strict=True)
        )  # without the fields' dtypes and dimensions, which `from_buffer` does not read
        return self.ffi.new("Scene *", [shapes, boxes, body]), held

    def least_along(self, scene: Any, poses: Any, steps: int, bulges: Any, most: float) -> float:  # noqa: ANN401 - arrays
        """Return the least clearance along poses."""
        packed, _held = self.packed(scene)
        buffer = self.ffi.from_buffer
        return self.lib.least_along(packed, buffer("double[]", poses), steps, buffer("double[]", bulges), most)

    def mark_touched(self, scene: Any, pose: Any, margin: float, is_touched: Any) -> None:  # noqa: ANN401 - arrays
        """Mark the shapes that a car at a pose touches."""
        packed, _held = self.packed(scene)
        flags = self.ffi.from_buffer("bool[]", is_touched, require_writable=True)
        self.lib.mark_touched(packed, self.ffi.from_buffer("double[]", pose), margin, flags)
