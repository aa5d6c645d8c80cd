"""Kinds of change in the words that a student reads; a kind that is not here says itself."""

from __future__ import annotations

_WORDS = {
    "another name": "one of the names, which is the wrong one",
    "an index": "an index, which is the wrong one",
    "a number": "a number, which is the wrong one",
    "another vector": "one of the vectors, wrong there or in its own line: a matrix times a vector, or the inverse of "
    "one times a vector, belongs there",
    "a sign": "a sign, which is the other way round",
    "brackets": "brackets, which are left out or stand in the wrong place",
    "brackets around another part": "something done to a part of an expression that belongs to the whole of it, or the "
    "other way round",
    "dtype= too many": "the dtype, which cuts decimals off",
    "astype() too many": "astype(), which cuts decimals off",
    "the axis": "the axis, which is the wrong one",
    "and / or": "and where or belongs, or the other way round",
    "& / |": "& where | belongs, or the other way round",
    "a condition at its edge": "a condition at its edge: with or without equality",
    "unlike the line of its twin": "one of two twin lines (two bodies, two points), which is not the other with its "
    "names exchanged",
    "the names of another pair": "two names in a difference or product, where two others belong",
    "dot() where the dot product of vectors belongs": "dot(), which pairs whole arrays, where a sum of products over "
    "axis=-1 belongs",
    "another expression than the cross product": "an expression, where the cross product of two vectors in it belongs",
    "another expression than the dot product": "an expression, where the dot product of two vectors in it belongs",
    "a condition of another kind": "a comparison, which is the wrong one",
    "one over it missing": "one over it (1/...), which is missing",
    "the shape of the result": "the shape of the result, which has an axis too many or too few",
}


def in_words(kind: str) -> str:
    """What is said of a kind of change."""
    return _WORDS.get(kind, kind)
