"""Kinds of change in the words that a student reads; a kind that is not here says itself."""

from __future__ import annotations

_WORDS = {
    "another name": "one of the names, which is the wrong one",
    "an index": "an index, which is the wrong one",
    "a number": "a number, which is the wrong one",
    "another vector": "one of the vectors, which is the wrong one",
    "a sign": "a sign, which is the other way round",
    "brackets": "brackets, which are left out or stand in the wrong place",
    "dtype= too many": "the dtype, which cuts decimals off",
    "astype() too many": "astype(), which cuts decimals off",
    "the axis": "the axis, which is the wrong one",
    "and / or": "and where or belongs, or the other way round",
    "& / |": "& where | belongs, or the other way round",
    "a condition at its edge": "a condition at its edge: with or without equality",
    "unlike the line of its twin": "what stands here for one of the two and there for the other",
    "the names of another pair": "two names in a difference or product, where two others belong",
    "dot() where the dot product of vectors belongs": "dot(), which pairs whole arrays, where a sum of products over "
    "axis=-1 belongs",
    "another product than the cross product": "a product where a cross product of other vectors belongs",
    "another product than the dot product": "a product where a dot product of other vectors belongs",
    "one over it missing": "one over it (1/...), which is missing",
    "the shape of the result": "the shape of the result, which has an axis too many or too few",
}


def in_words(kind: str) -> str:
    """What is said of a kind of change."""
    return _WORDS.get(kind, kind)
