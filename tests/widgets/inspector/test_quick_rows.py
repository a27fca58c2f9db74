"""The typesetter with quick rows draws what it draws without them, also where brackets and roots grow."""

import json
import subprocess
import sys

FORMULAS = (
    r"\left( \frac{a}{\frac{b}{c}} \right)^2 = \overline{x y} + \underbrace{a + b}_{c}",
    r"\det \begin{pmatrix} \textcolor{#0068a3}{x_0} & y_0 \\ x_1 & \frac{1}{2} \end{pmatrix}",
    r"\left[ \begin{array}{c} 1 \\ 2 \end{array} \right] \left\{ x \right\} \left| \frac{1}{2} \right|",
    r"\left( x + \left( \frac{1}{2} + \left( y \right) \right) \right) \left\lfloor \frac{1}{2} \right\rfloor",
    r"\sum_{i=0}^{n} \sqrt{\frac{a}{b}} \cdot \operatorname{clamp}(x, 0, 1) \widehat{abc}",
)
PROGRAM = """
import json, sys, warnings
warnings.simplefilter("ignore")
from ziamath import zmath
zmath.config.svg2 = False
formulas = json.load(sys.stdin)
def draw():
    return [zmath.Latex(text, size=17.2, color="#101010", margin=0.5).svg() for text in formulas]
plain = draw()
import widgets.inspector.quick_rows
json.dump([one == other for one, other in zip(plain, draw())], sys.stdout)
"""


def test_the_drawings_are_the_same() -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input=json.dumps(FORMULAS),
        capture_output=True,
        text=True,
        check=True,
    )
    assert json.loads(done.stdout) == [True] * len(FORMULAS)
