"""The history of a pixel in words: every key has its sentence, and the sentence has the right numbers."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings
from core.methods import table
from core.pixel_history import told, why
from core.pixel_history.fragments import Link, PixelHistory
from core.settings import families
from core.trace.source import TraceSource
from tests.core.strategies import ANY_TRIANGLES


def all_texts(history: PixelHistory) -> list[str]:
    """Return every sentence of a history."""
    texts = [told.verdict_sentence(history), *told.count_sentences(history)]
    for event in history.events:
        texts += [told.event_reason(event), *map(told.link_sentence, event.chain)]
    return texts


def check_texts(texts: list[str]) -> None:
    for text in texts:
        assert re.fullmatch(r"[A-Z0-9].*\.", text), text
        assert not re.search(r"nan|inf\b|\bNone\b(?! of )|\.\.|  |\bTrue|\bFalse|array", text), text


ANY_SETTINGS = st.builds(Settings, **{family: st.sampled_from(table.names(family)) for family in families()})


@given(ANY_TRIANGLES, ANY_SETTINGS, st.data())
def test_every_history_can_be_told(case, settings, data):
    clip, size = case
    pixel = data.draw(st.integers(0, size[0] - 1)), data.draw(st.integers(0, size[1] - 1))
    triangle = data.draw(st.none() | st.integers(0, len(clip) - 1))
    check_texts(all_texts(why(TraceSource(ClipScene(clip, size=size), settings), *pixel, triangle)))


def test_no_key_is_without_a_sentence_and_no_sentence_without_a_key():
    values = {"values": np.zeros(3), "inside": np.ones(3, bool)}
    with pytest.raises(KeyError):
        told.link_sentence(Link("raster", "lost", values))
    stages = {stage for stage, _ in told.SENTENCES}
    assert stages == {
        *("verdict", "transform", "cull", "clip", "bin", "raster"),
        *("interpolate", "shade", "depth", "blend", "resolve"),
    }
    assert set(told.COUNTED) == {
        *("back-facing", "front-facing", "degenerate", "behind-eye"),
        *("outside-plane", "with-its-box", "behind-occluders"),
        *("clipped-away", "outside-box", "missed", "no-fragment"),
    }
