"""Where the typesetter cannot be loaded, formulas are plain text, and nothing waits for it."""

from functools import cache

from core.explain.records import Formula
from widgets.inspector import formula_view, typesetter
from widgets.inspector.formula_view import FormulaView


def test_a_typesetter_that_cannot_be_loaded_is_not_waited_for(qtbot, monkeypatch, capfd):
    @cache
    def missing():
        raise ImportError("there is no ziamath")

    monkeypatch.setattr(typesetter, "_typesetting", missing)
    typesetter.load_typesetter.cache_clear()
    view = FormulaView()
    qtbot.addWidget(view)
    view.show_formula(Formula(r"u_9 = v_7", r"97 = 97"))
    qtbot.waitUntil(view.is_complete, timeout=20000)
    assert "Shown as plain text: import: there is no ziamath" in view.tip()
    assert capfd.readouterr().err == ""
    typesetter.load_typesetter.cache_clear()
    # Formulas of other tests that waited meanwhile became plain text, too.
    formula_view._SHARED._cells.clear()
