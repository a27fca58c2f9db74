"""Starting long work, cancelling it, and how far it has come: the same controls on every page that runs something."""

from PySide6.QtWidgets import QProgressBar, QPushButton, QSizePolicy, QWidget

from widgets.basics.elided_label import ElidedLabel
from widgets.basics.message_bar import Progress


class RunControls:
    """Four widgets that a layout takes one by one; start and cancel are never seen together."""

    def __init__(self, start: str, start_tip: str, cancel_tip: str, parent: QWidget) -> None:
        """Make the widgets; ``start`` is what the button says."""
        self.start_button = QPushButton(start, parent)
        self.start_button.setToolTip(start_tip)
        self.cancel_button = QPushButton("Cancel", parent)
        self.cancel_button.setToolTip(cancel_tip)
        self.progress = QProgressBar(parent)
        self.progress.setTextVisible(False)
        self.progress.setFixedSize(160, 8)
        self.doing = ElidedLabel(parent)
        self.doing.setProperty("role", "muted")
        self.doing.setFixedWidth(320)
        # An elided label takes any width by itself; here it keeps its own, so that a line that is full wraps.
        self.doing.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)

    @property
    def widgets(self) -> tuple[QWidget, ...]:
        """In the order in which they stand."""
        return (self.start_button, self.cancel_button, self.progress, self.doing)

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far the work has come; ``None``: nothing runs."""
        is_running = progress is not None
        had_focus = self.start_button.hasFocus() or self.cancel_button.hasFocus()
        for widget in (self.cancel_button, self.progress, self.doing):
            widget.setVisible(is_running)
        self.start_button.setVisible(not is_running)
        if had_focus:  # One takes the place of the other, for the keyboard too.
            (self.cancel_button if is_running else self.start_button).setFocus()
        if progress is not None:
            self.progress.setRange(0, progress.total)
            self.progress.setValue(progress.done)
            self.progress.setAccessibleName(progress.text)
            self.doing.setText(progress.text)
