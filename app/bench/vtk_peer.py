"""VTK: a scene graph on the OpenGL of this machine, drawing meshes off screen, its pixels read back."""

from contextlib import ExitStack
from math import degrees
from typing import Any

import numpy as np

from app.bench.records import Bytes, Contender, Lighting, Prepared, ViewedMesh, Work

LIBRARY = "VTK"
DISTRIBUTION = "vtk"


def contender(work: Work) -> Contender | None:
    """Return VTK drawing ``work``, or ``None``: it is asked to draw meshes only."""
    if not isinstance(work, ViewedMesh):
        return None
    has_highlight = work.lighting is not None and work.lighting.specular > 0
    differs = "Phong's highlight, not Blinn's" if has_highlight else ""
    return Contender(LIBRARY, "graphics", lambda stack: prepare(work, stack), differs)


def prepare(work: ViewedMesh, stack: ExitStack) -> Prepared:
    """Build the scene graph, which draws itself anew on every call."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the implementation behind vtkRenderWindow)
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkLogger, vtkUnsignedCharArray
    from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

    # It tries X before EGL and tells so on stderr; what then fails is raised here all the same.
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    renderer = vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AutomaticLightCreationOff()
    renderer.AddActor(make_actor(work))
    aim_camera(renderer.GetActiveCamera(), work)
    if work.lighting is not None:
        add_light(renderer, work.lighting)

    window = vtkRenderWindow()
    stack.callback(window.Finalize)
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*work.size)
    window.AddRenderer(renderer)
    (width, height), memory = work.size, vtkUnsignedCharArray()

    def run() -> Bytes:
        window.Render()
        window.GetPixelData(0, 0, width - 1, height - 1, 0, memory, 0)
        return np.asarray(vtk_to_numpy(memory)).reshape(height, width, 3)

    run()
    return Prepared(run, window.GetClassName)


def make_actor(work: ViewedMesh) -> Any:
    """Return the mesh with its colours, texture and material."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    points, cells, mesh = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(work.positions.astype(np.float32), deep=True))
    offsets = np.arange(0, 3 * len(work.triangles) + 1, 3)
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_to_vtkIdTypeArray(work.triangles.ravel(), deep=True),
    )
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    values = mesh.GetPointData()
    values.SetNormals(numpy_to_vtk(work.normals.astype(np.float32), deep=True))
    if work.colors is not None:
        values.SetScalars(numpy_to_vtk(np.rint(work.colors * 255).astype(np.uint8), deep=True))
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    actor = vtkActor()
    actor.SetMapper(mapper)
    if work.texture is not None:
        assert work.uvs is not None
        values.SetTCoords(numpy_to_vtk(work.uvs.astype(np.float32), deep=True))
        actor.SetTexture(make_texture(work.texture))
    set_material(actor.GetProperty(), work.lighting)
    return actor


def make_texture(texels: Bytes) -> Any:
    """Return an image (h, w, 3) as a texture that is repeated and filtered bilinearly."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkRenderingCore import vtkTexture

    image = vtkImageData()
    image.SetDimensions(texels.shape[1], texels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(texels.reshape(-1, 3), deep=True))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.InterpolateOn()
    texture.RepeatOn()
    return texture


def set_material(surface: Any, light: Lighting | None) -> None:
    """Set how the surface answers the light, and that its back is not seen."""
    surface.BackfaceCullingOn()
    if light is None:
        surface.LightingOff()
        return
    surface.SetInterpolationToPhong() if light.is_per_pixel else surface.SetInterpolationToGouraud()
    surface.SetAmbient(light.ambient)
    surface.SetDiffuse(light.diffuse)
    surface.SetSpecular(light.specular)
    surface.SetSpecularPower(light.shininess)


def aim_camera(camera: Any, work: ViewedMesh) -> None:
    """Put the camera where the workload has it."""
    camera.SetPosition(*work.eye)
    camera.SetFocalPoint(*work.target)
    camera.SetViewUp(*work.up)
    camera.SetViewAngle(degrees(work.field_of_view))
    camera.SetClippingRange(work.near, work.far)


def add_light(renderer: Any, light: Lighting) -> None:
    """Add the one light, and white light from everywhere."""
    from vtkmodules.vtkRenderingCore import vtkLight

    sun = vtkLight()
    sun.SetLightTypeToSceneLight()
    sun.PositionalOff()
    sun.SetPosition(*-light.direction)
    sun.SetFocalPoint(0, 0, 0)
    renderer.AddLight(sun)
    renderer.SetAmbient(1, 1, 1)
