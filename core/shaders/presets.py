"""Shaders to begin with: those of the slides, word for word, and the ways of shading that the lectures name."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from core.scene import Scene
from core.shaders.record import ShaderProgram

MINIMAL_VERTEX = """#version 300 es
precision highp float;
in vec3 position;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
void main() {
   gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
"""
MINIMAL_FRAGMENT = """#version 300 es
precision highp float;

out vec4 out_frag_color;

void main() {
   out_frag_color = vec4(1.0, 1.0, 0.0, 1.0); // yellow
}
"""
TASK_VERTEX = """#version 300 es
precision highp float;
// define the out to transmit the vertex color to
// the subsequent shaders
out vec3 vColor;
void main() {
   // TODO: scale x by 1.5, y by 0.5, and z by 2.0
   gl_Position = projectionMatrix * modelViewMatrix * vec4(
       position.x*1.5,
       position.y*0.5,
       position.z*2.0,
       1.0
   );
   // TODO: set the vColor out to the color we recieved
   // from the three.js code
   vColor = color;
}
"""
TASK_FRAGMENT = """#version 300 es
precision highp float;
out vec4 outColor;
// TODO: define the in to receive
// the (interpolated) vertex color
// from the previous shaders
in vec3 vColor;
void main() {
   outColor = vec4(vColor, 1.0);
}
"""
VERTEX = """#version 300 es
precision highp float;
out vec3 vPosition; // seen from the eye
out vec3 vWorld;
out vec3 vNormal;
out vec3 vColor;
out vec2 vUv;
void main() {
   vec4 seen = modelViewMatrix * vec4(position, 1.0);
   vPosition = seen.xyz;
   vWorld = (modelMatrix * vec4(position, 1.0)).xyz;
   vNormal = normalMatrix * normal;
   vColor = color;
   vUv = uv;
   gl_Position = projectionMatrix * seen;
}
"""
"""Hands on everything that a fragment shader may want."""
_HEAD = """#version 300 es
precision highp float;
in vec3 vPosition;
in vec3 vWorld;
in vec3 vNormal;
in vec3 vColor;
in vec2 vUv;
"""
_LIGHT = """uniform vec4 lightSource; // w = 0: the way its light travels; w = 1: its place
uniform vec3 lightColor;
uniform vec4 fillSource; // a second light
uniform vec3 fillColor;
uniform float ambient;
uniform float diffuse;
uniform float specular;
uniform float shininess;
"""
_TRAVELS = """vec3 travels(vec4 source, vec3 place) {
   return source.w > 0.5 ? place - source.xyz : source.xyz;
}
"""
_LIT = f"""{_TRAVELS}vec3 lit(vec3 N, vec3 V, vec3 surface, vec3 direction, vec3 strength) {{
   vec3 L = normalize(mat3(viewMatrix) * -direction);
   float cosine = dot(N, L);
   if (cosine <= 0.0) return vec3(0.0);
   vec3 H = normalize(L + V);
   float power = pow(max(dot(N, H), 0.0), shininess);
   return (surface * diffuse * cosine + specular * power) * strength;
}}
"""
_LIGHTS = """   light += lit(N, V, vColor, travels(lightSource, vWorld), lightColor);
   light += lit(N, V, vColor, travels(fillSource, vWorld), fillColor);
"""
_EYE = "isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(-vPosition)"
_TURNED = "   if (!gl_FrontFacing) N = -N; // seen from behind\n"
PHONG = f"""{_HEAD}{_LIGHT}out vec4 outColor;
{_LIT}void main() {{
   vec3 N = normalize(vNormal);
{_TURNED}   vec3 V = {_EYE};
   vec3 light = vColor * ambient;
{_LIGHTS}   outColor = vec4(light, 1.0);
}}
"""
FLAT = PHONG.replace(_TURNED, "").replace(
    "normalize(vNormal)", "normalize(cross(dFdx(vPosition), dFdy(vPosition)))"
)
GOURAUD_VERTEX = f"""#version 300 es
precision highp float;
{_LIGHT}out vec3 vLight;
{_LIT}void main() {{
   vec4 seen = modelViewMatrix * vec4(position, 1.0);
   vec3 N = normalize(normalMatrix * normal);
   vec3 V = {_EYE.replace("vPosition", "seen.xyz")};
   vec3 place = (modelMatrix * vec4(position, 1.0)).xyz;
   vec3 light = color * ambient;
{_LIGHTS.replace("vColor", "color").replace("vWorld", "place")}   vLight = light;
   gl_Position = projectionMatrix * seen;
}}
"""
GOURAUD_FRAGMENT = """#version 300 es
precision highp float;
in vec3 vLight;
out vec4 outColor;
void main() {
   outColor = vec4(vLight, 1.0);
}
"""
TOON = f"""{_HEAD}uniform vec4 lightSource; // w = 0: the way its light travels; w = 1: its place
uniform float steps;
out vec4 outColor;
{_TRAVELS}void main() {{
   vec3 N = normalize(vNormal);
{_TURNED}   vec3 L = normalize(mat3(viewMatrix) * -travels(lightSource, vWorld));
   float cosine = max(dot(N, L), 0.0);
   float band = floor(cosine * steps + 0.5) / steps;
   outColor = vec4(vColor * (0.2 + 0.8 * band), 1.0);
}}
"""
CHECKER = f"""{_HEAD}uniform float squares;
out vec4 outColor;
void main() {{
   vec2 square = floor(vUv * squares);
   bool isLight = mod(square.x + square.y, 2.0) < 0.5;
   outColor = vec4(isLight ? vColor : vColor * 0.25, 1.0);
}}
"""
NORMALS = f"""{_HEAD}out vec4 outColor;
void main() {{
   vec3 N = normalize(vNormal);
   outColor = vec4(N * 0.5 + 0.5, 1.0);
}}
"""
DEPTH = """#version 300 es
precision highp float;
out vec4 outColor;
void main() {
   float depth = gl_FragCoord.z;
   outColor = vec4(depth, depth, depth, 1.0);
}
"""
ALPHA_TEST = f"""{_HEAD}uniform float threshold;
out vec4 outColor;
void main() {{
   float alpha = length(fract(vUv * 6.0) - 0.5);
   if (alpha < threshold) discard;
   outColor = vec4(vColor, 1.0);
}}
"""
WAVE = VERTEX.replace("void main() {", "uniform float time;\nuniform float height;\nvoid main() {").replace(
    "vec4(position, 1.0)", "vec4(position + height * sin(6.0 * position.x + time) * normal, 1.0)"
)


@dataclass(frozen=True)
class Preset:
    """A pair of shaders with a title."""

    title: str
    vertex: str
    fragment: str
    uniforms: Mapping[str, tuple[float, ...]]
    dialect: str = "shader-material"


_NONE: dict[str, tuple[float, ...]] = {}
PRESETS = {
    "minimal": Preset(
        "Minimal shaders (LMU)", MINIMAL_VERTEX, MINIMAL_FRAGMENT, _NONE, "raw-shader-material"
    ),
    "task": Preset("Task 2 g) (LMU)", TASK_VERTEX, TASK_FRAGMENT, _NONE),
    "flat": Preset("Flat shading", VERTEX, FLAT, _NONE),
    "gouraud": Preset("Gouraud shading", GOURAUD_VERTEX, GOURAUD_FRAGMENT, _NONE),
    "phong": Preset("Phong shading", VERTEX, PHONG, _NONE),
    "toon": Preset("Toon shading", VERTEX, TOON, {"steps": (3.0,)}),
    "checker": Preset("Checkerboard", VERTEX, CHECKER, {"squares": (8.0,)}),
    "normals": Preset("Normals as colours", VERTEX, NORMALS, _NONE),
    "depth": Preset("Depth as grey", MINIMAL_VERTEX, DEPTH, _NONE, "raw-shader-material"),
    "alpha-test": Preset("Alpha test with discard", VERTEX, ALPHA_TEST, {"threshold": (0.3,)}),
    "wave": Preset("Wave in the vertex shader", WAVE, PHONG, {"time": (0.0,), "height": (0.1,)}),
}
"""By name."""


def preset_of(program: ShaderProgram) -> str:
    """Return the name of the preset whose texts a program has; empty: they are other ones."""
    texts = (program.vertex, program.fragment)
    same = (
        n
        for n, of in PRESETS.items()
        if texts in ((of.vertex, of.fragment), (of.vertex, _textured(of.fragment)))
    )
    return next(same, "")


def preset_program(name: str, scene: Scene) -> ShaderProgram:
    """Return a preset for a scene, which gives it light, material, and in the lit ones its texture.

    Raises ValueError for a name that is not one of `PRESETS`.
    """
    if name not in PRESETS:
        raise ValueError(f"preset must be one of {', '.join(PRESETS)}, got {name}")
    preset, is_textured = PRESETS[name], any(mesh.texture is not None for mesh in scene.meshes)
    fragment = _textured(preset.fragment) if is_textured else preset.fragment
    own = tuple(preset.uniforms.items())
    return ShaderProgram(preset.vertex, fragment, own, preset.dialect, preset.title)


def _textured(fragment: str) -> str:
    """Return a lit fragment shader with the texture's colour in its surface; another one unchanged."""
    if "light = vColor * ambient" not in fragment:
        return fragment
    for old, new in (
        ("out vec4 outColor;", "uniform sampler2D map;\nout vec4 outColor;"),
        (
            "   vec3 light = vColor",
            "   vec3 surface = vColor * texture(map, vUv).rgb;\n   vec3 light = surface",
        ),
        ("lit(N, V, vColor,", "lit(N, V, surface,"),
    ):
        fragment = fragment.replace(old, new)
    return fragment


def retyped(program: ShaderProgram, vertex: str, fragment: str) -> ShaderProgram:
    """Return shaders with other texts, and the same uniforms.

    Raises `ShaderProblem` or ValueError as `ShaderProgram`.
    """
    return replace(program, vertex=vertex, fragment=fragment)
