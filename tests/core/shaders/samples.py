"""Shaders that tests share, and lanes to run them on."""

import numpy as np

from core.shaders.glsl_types import GlslValue, from_rows
from core.shaders.shader import Shader

HEAD = "#version 300 es\nprecision highp float;\nin vec4 a;\nin vec4 b;\nuniform float t;\nout vec4 c;\n"
MANDELBROT = (
    HEAD
    + """float rounds(vec2 p) {
   vec2 z = vec2(0.0);
   for (int i = 0; i < 40; i++) {
      z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + p;
      if (dot(z, z) > 4.0) return float(i);
   }
   return 40.0;
}
void main() {
   float k = rounds(a.xy * 0.6);
   if (k > 39.5) discard;
   c = vec4(k / 40.0);
}
"""
)
PHONG = (
    HEAD
    + """void main() {
   vec3 N = normalize(a.xyz);
   vec3 L = normalize(b.xyz);
   float cosine = dot(N, L);
   vec3 color = b.xyz * 0.12;
   if (cosine > 0.0) {
      vec3 H = normalize(L + vec3(0.0, 0.0, 1.0));
      color += b.xyz * cosine;
      color += 0.25 * pow(max(dot(N, H), 0.0), 32.0);
   } else if (cosine < -0.5) {
      color.r = 1.0;
   }
   c = vec4(color, 1.0);
}
"""
)
DIVERGENT = (
    HEAD
    + """vec2 total = vec2(0.0);
void stop(float x) { if (x > 3.0) discard; total.y += 1.0; }
float pick(float x) {
   if (x < 0.0) { return -x; }
   while (x > 1.0) {
      x *= 0.5;
      if (x > 1.7) continue;
      if (x < 1.2) break;
      total += vec2(0.5);
   }
   return x;
}
void main() {
   stop(a.x);
   float first = pick(a.y);
   for (int i = 0; i < 6; i++) {
      float k = float(i);
      if (k > abs(b.x) + 1.0) break;
      stop(a.z - k);
      first = a.w > 0.0 ? first + pick(k) : first * 2.0;
      { float first = 7.0; total.x += first * 0.125; }
   }
   c = vec4(first, total, t);
}
"""
)
SAMPLES = {"mandelbrot": MANDELBROT, "phong": PHONG, "divergent": DIVERGENT}


def shader_of(source: str) -> Shader:
    """Return a fragment shader that declares everything itself."""
    return Shader(source, "fragment", "raw-shader-material")


def random_lanes(count: int, seed: int = 1) -> dict[str, GlslValue]:
    """Return ``a`` in (-4, 4) and ``b`` in (0.1, 4) of some lanes, and ``t``."""
    rng = np.random.default_rng(seed)
    return {
        "a": from_rows("vec4", rng.uniform(-4, 4, (count, 4))),
        "b": from_rows("vec4", rng.uniform(0.1, 4, (count, 4))),
        "t": from_rows("float", 0.25),
    }


def lane_of(given: dict[str, GlslValue], k: int) -> dict[str, GlslValue]:
    """Return the values of one lane."""
    return {
        name: GlslValue(
            value.of, tuple(part if np.ndim(part) == 0 else part[k : k + 1] for part in value.parts)
        )
        for name, value in given.items()
    }
