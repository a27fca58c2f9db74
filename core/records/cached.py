"""Attributes that are computed when they are first asked for, by any number of threads.

``functools.cached_property`` of Python 3.11 computes under one lock for all instances of a class, so work in the
background would hold up a window that asks another instance for the same. Here there is no lock: threads that ask one
instance at a time may all compute, which gives the same result, as what is computed here never changes.
"""

from collections.abc import Callable
from typing import Any, Generic, Self, TypeVar, overload

Value = TypeVar("Value")


class cached_property(Generic[Value]):  # noqa: N801
    """A method without arguments as an attribute that is kept, also of a frozen record."""

    def __init__(self, compute: Callable[[Any], Value]) -> None:
        self._compute = compute
        self.__doc__ = compute.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...

    @overload
    def __get__(self, instance: object, owner: type) -> Value: ...

    def __get__(self, instance: object | None, owner: type) -> Self | Value:
        if instance is None:
            return self
        # Asked only while it is not in the record's own dictionary, which is looked at first.
        value = self._compute(instance)
        vars(instance)[self._name] = value
        return value
