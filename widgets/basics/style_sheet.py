"""The style sheet and the palette of a theme: space separates panels, controls are flat, focus is a clear ring."""

from pathlib import Path
from string import Template

from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication

from widgets.basics.theme import Theme, text_font, theme_notifier

_SHEET = Template("""
QToolTip { background: $raised; color: $text; border: 1px solid $outline; padding: ${u}px; }

QPushButton, QComboBox, QToolButton, QCheckBox, QRadioButton { outline: none; }
QPushButton, QComboBox, QToolButton {
    background: $raised; color: $text; border: 1px solid $outline; border-radius: 3px;
    padding: 3px ${uu}px; min-height: ${control}px;
}
QToolButton { padding: 3px ${u}px; }
QToolButton[flat="true"], QPushButton[flat="true"] { background: transparent; border-color: transparent; }
QPushButton:hover, QComboBox:hover, QToolButton:hover,
QToolButton[flat="true"]:hover, QPushButton[flat="true"]:hover { background: $selection; }
QPushButton:pressed, QToolButton:pressed { background: $outline; }
QPushButton[role="primary"] { background: $text; color: $panel; border-color: $text; }
QPushButton[role="primary"]:hover { background: $muted_text; }
QPushButton[role="primary"]:focus { background: $selection; color: $text; }
QPushButton:checked, QToolButton:checked, QToolButton[flat="true"]:checked {
    background: $selection; color: $text; border-color: $text;
}
QPushButton:focus, QComboBox:focus, QToolButton:focus, QLineEdit:focus, QAbstractSpinBox:focus,
QToolButton[flat="true"]:focus, QPlainTextEdit:focus {
    border: 2px solid $focus; padding: 2px ${u}px;
}
QPushButton:focus, QComboBox:focus { padding: 2px ${uu_focus}px; }
QPushButton:disabled, QToolButton:disabled, QComboBox:disabled { color: $outline; border-color: $selection; }
QComboBox::drop-down { border: none; width: 20px; }
QComboBox::down-arrow, QAbstractSpinBox::down-arrow {
    image: url($icons/down-$ink.svg); width: 10px; height: 10px;
}
QAbstractSpinBox::up-arrow { image: url($icons/up-$ink.svg); width: 10px; height: 10px; }
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button {
    border: none; width: 16px; subcontrol-origin: padding;
}
QAbstractSpinBox::up-button { subcontrol-position: top right; }
QAbstractSpinBox::down-button { subcontrol-position: bottom right; }
QAbstractSpinBox::up-button:hover, QAbstractSpinBox::down-button:hover { background: $selection; }
/* A list under the box: as a menu over it, Qt cuts the last choice off. */
QComboBox { combobox-popup: 0; }
QComboBox QAbstractItemView { background: $panel; border: 1px solid $outline; padding: ${u}px; }
QComboBox QAbstractItemView::item { min-height: ${control}px; padding: 3px ${u}px; }

QLineEdit, QAbstractSpinBox, QPlainTextEdit, QTextEdit, QTextBrowser {
    background: $panel; color: $text; border: 1px solid $outline; border-radius: 3px; padding: 3px ${u}px;
    selection-background-color: $selection; selection-color: $text;
}
QLineEdit:disabled { color: $outline; }
QTextBrowser, QTextEdit[readOnly="true"], QPlainTextEdit[readOnly="true"] { border: 1px solid transparent; }
QTextBrowser:focus, QTextEdit[readOnly="true"]:focus, QPlainTextEdit[readOnly="true"]:focus {
    border: 2px solid $focus; padding: 2px ${u}px;
}
ListingView { padding: 3px 1px; }
ListingView:focus { padding: 2px 0px; }
QSlider { border: 2px solid transparent; border-radius: 3px; }
QSlider:focus { border-color: $focus; }

QCheckBox, QRadioButton { spacing: ${uu}px; padding: 2px; border: 2px solid transparent; border-radius: 3px; }
QCheckBox:focus, QRadioButton:focus { border-color: $focus; }
QCheckBox:disabled, QRadioButton:disabled { color: $outline; }
QCheckBox::indicator, QRadioButton::indicator, QMenu::indicator, QAbstractItemView::indicator {
    width: ${indicator}px; height: ${indicator}px; background: $raised;
    border: 1px solid $outline; border-radius: 2px;
}
QRadioButton::indicator { border-radius: ${round}px; }
QCheckBox::indicator:checked, QMenu::indicator:checked, QAbstractItemView::indicator:checked {
    image: url($icons/tick-$ink.svg);
}
QRadioButton::indicator:checked { image: url($icons/dot-$ink.svg); }
QCheckBox::indicator:disabled, QRadioButton::indicator:disabled { border-color: $selection; }
QMenu::indicator { margin-left: ${u}px; }

QAbstractItemView { background: $panel; alternate-background-color: $window; border: none; outline: none; }
QAbstractItemView:focus { border: 2px solid $focus; }
QTableView, QTreeView { border: 2px solid transparent; }
QTableView:focus, QTreeView:focus { border-color: $focus; }
QAbstractItemView::item { border: 1px solid transparent; border-width: 1px 0; }
QAbstractItemView::item:selected { background: $selection; color: $text; border-color: $text; }
QHeaderView::section { background: $panel; color: $muted_text; border: none; padding: ${u}px; }
QHeaderView::section:vertical { padding: 0 ${u}px; }
QTableView { gridline-color: $window; }
QTableCornerButton::section { background: $panel; border: none; }

QMenuBar, QMenu { background: $panel; color: $text; }
QMenuBar::item { padding: ${u}px ${uu}px; background: transparent; border: 1px solid transparent; }
QMenuBar::item:selected, QMenu::item:selected { background: $selection; color: $text; border-color: $text; }
QMenu { border: 1px solid $outline; padding: ${u}px; }
QMenu::item { padding: ${u}px ${uuuuuu}px; border: 1px solid transparent; border-radius: 3px; }
QMenu::item:disabled { color: $outline; }
QMenu::separator { height: 1px; background: $selection; margin: ${u}px; }

QTabWidget::pane { border: none; }
QTabBar::tab {
    background: transparent; color: $muted_text; padding: ${u}px ${uu}px; border: 2px solid transparent;
}
QTabBar::tab:selected { color: $text; border-bottom-color: $text; }
QTabBar::scroller { width: 48px; }
QTabBar QToolButton { min-width: 14px; padding: 3px ${u}px; }
QListView::item { min-height: 24px; }
QSlider:horizontal { min-height: 24px; }
QTabBar::tab:focus { border-color: $focus; }

QSplitter::handle:horizontal { width: ${uu}px; }
QSplitter::handle:vertical { height: ${uu}px; }
QScrollArea { border: none; background: transparent; }
QScrollArea:focus { border: 2px solid $focus; }
QScrollBar { background: transparent; border: none; }
QScrollBar:vertical { width: 12px; }
QScrollBar:horizontal { height: 12px; }
QScrollBar::handle { background: $outline; border-radius: 3px; margin: 3px; }
QScrollBar::handle:vertical { min-height: 28px; }
QScrollBar::handle:horizontal { min-width: 28px; }
QScrollBar::handle:hover { background: $muted_text; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }

QStatusBar { background: $window; color: $muted_text; }
QStatusBar::item { border: none; }
QProgressBar { background: $panel; border: 1px solid $outline; border-radius: 3px; text-align: center; }
QProgressBar::chunk { background: $outline; }
QLabel[role="muted"] { color: $muted_text; }
QLabel[role="title"] { font-size: ${title_px}px; font-weight: 600; }
QLabel[role="strong"] { font-weight: 600; }
QLabel[role="bad"] { color: $bad; }
QLabel[role="good"] { color: $good; }
QLabel[role="key"] { background: $raised; border: 1px solid $outline; border-radius: 3px; padding: 1px 5px; }
QWidget[role="panel"] { background: $panel; border-radius: 4px; }
QWidget[role="floating"] { background: $raised; border: 1px solid $outline; border-radius: 4px; }
QWidget[role="floating"] QLabel { border: none; background: transparent; }
QWidget[role="kept"] { background: $raised; border-left: ${u}px solid $text; }
""")


def style_sheet(theme: Theme) -> str:
    """Return the application's style sheet for ``theme``.

    Labels may set the property ``role`` to muted, title, strong, key, good or bad, containers to panel or kept, the one
    main button of a page to primary, and buttons ``flat`` to true.
    """
    unit = theme.unit
    names = (
        *("window", "panel", "raised", "outline", "text", "muted_text", "focus", "selection"),
        *("good", "bad"),
    )
    colors = {name: getattr(theme, name) for name in names}
    return _SHEET.substitute(
        colors,
        u=unit,
        uu=2 * unit,
        uu_focus=2 * unit - 1,
        uuuuuu=6 * unit,
        control=theme.text_px + 3,
        indicator=theme.text_px + 1,
        round=(theme.text_px + 3) // 2,
        ink="light" if theme.is_dark else "dark",
        icons=(Path(__file__).parent / "icons").as_posix(),
        title_px=theme.title_px,
    )


def apply_theme(app: QApplication, theme: Theme) -> None:
    """Give the application the palette, the font and the style sheet of ``theme``, and tell every widget.

    Applying the present theme again changes nothing and tells nobody.
    """
    notifier = theme_notifier()
    sheet = style_sheet(theme)
    if theme == notifier.theme and app.styleSheet() == sheet:
        return
    notifier.theme = theme
    # From no sheet to another one takes Qt a quarter of the time that it takes from one sheet to another.
    app.setStyleSheet("")
    if app.style().name() != "fusion":
        app.setStyle("Fusion")
    app.setPalette(palette(theme))
    app.setFont(text_font(theme))
    app.setStyleSheet(sheet)
    notifier.theme_changed.emit(theme)


def palette(theme: Theme) -> QPalette:
    """Return the Qt palette of a theme."""
    role = QPalette.ColorRole
    colors = {
        role.Window: theme.window,
        role.WindowText: theme.text,
        role.Base: theme.panel,
        role.AlternateBase: theme.window,
        role.Text: theme.text,
        role.Button: theme.raised,
        role.ButtonText: theme.text,
        role.BrightText: theme.text,
        role.ToolTipBase: theme.raised,
        role.ToolTipText: theme.text,
        role.PlaceholderText: theme.muted_text,
        role.Highlight: theme.selection,
        role.HighlightedText: theme.text,
        role.Link: theme.vertex_text[0],
        role.LinkVisited: theme.vertex_text[0],
    }
    result = QPalette()
    for key, value in colors.items():
        result.setColor(key, QColor(value))
    for key in (role.WindowText, role.Text, role.ButtonText):
        result.setColor(QPalette.ColorGroup.Disabled, key, QColor(theme.outline))
    return result
