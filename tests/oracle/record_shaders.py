"""Record what OpenGL computes with small shaders, for the tests that run without OpenGL.

From the top of the project, where the extra ``gpu`` is installed::

    python -m tests.oracle.record_shaders

makes the file of tests/oracle/shaders afresh: the answers of all cases of `app.opengl_check.shaders` on 8 x 8
pixels, and the pictures of the tutorial's shaders.
"""

import sys
from pathlib import Path

import numpy as np

from app.opengl_check.cases import OpenGLMissingError, OpenGLRenderer
from app.opengl_check.shaders import CASES, draw_scene_with_opengl, draw_with_opengl, shader_inputs
from core.scene import Scene
from core.shaders.presets import MINIMAL_FRAGMENT, MINIMAL_VERTEX
from tests.core.shaders.scenes import tutorial_scene

FILE = Path(__file__).parent / "shaders" / "answers.npz"
SIDE = 8
SEED = 46
SIZE = (64, 48)


def tutorial_scenes() -> dict[str, Scene]:
    """Return the tutorial's triangle with its two pairs of shaders."""
    return {
        "minimal": tutorial_scene(MINIMAL_VERTEX, MINIMAL_FRAGMENT, SIZE),
        "task": tutorial_scene(size=SIZE),
    }


def record() -> None:
    """Draw everything with OpenGL and write the file."""
    a, b = shader_inputs(SIDE, SEED)
    with OpenGLRenderer() as renderer:
        answers = {case.name: draw_with_opengl(renderer, case, a, b) for case in CASES}
        pictures = {
            name: draw_scene_with_opengl(renderer, scene) for name, scene in tutorial_scenes().items()
        }
        FILE.parent.mkdir(exist_ok=True)
        np.savez_compressed(
            FILE,
            names=np.array(list(answers)),
            answers=np.array(list(answers.values())),
            renderer=np.array(renderer.name),
            **pictures,
        )


if __name__ == "__main__":
    try:
        record()
    except OpenGLMissingError as error:
        sys.exit(f"record_shaders: {error}")
