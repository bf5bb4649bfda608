"""Picture of an exported field as ParaView draws it: python docs/_ext/vtk_picture.py FILE PICTURE."""

from __future__ import annotations

import sys

import matplotlib as mpl
import vtk

# Micrometres; the height is scaled once more.
_LENGTH, _HEIGHT = 1e6, 5e7


def main(file: str, picture: str) -> None:
    """Draw the block "field" of a VTKHDF file, coloured by its strength in V/µm."""
    reader = vtk.vtkHDFReader()
    reader.SetFileName(file)
    scaled = vtk.vtkTransform()
    scaled.Scale(_LENGTH, _LENGTH, _HEIGHT)
    reader.Update()
    field = vtk.vtkTransformFilter()
    field.SetInputData(reader.GetOutputDataObject(0).GetPartition(1, 0))
    field.SetTransform(scaled)
    strength = vtk.vtkArrayCalculator()
    strength.SetInputConnection(field.GetOutputPort())
    strength.AddScalarArrayName("strength")
    strength.SetFunction("strength*1e-6")
    strength.SetResultArrayName("field strength [V/µm]")
    strength.Update()
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for k, colour in enumerate(mpl.colormaps["viridis"](range(256))):
        table.SetTableValue(k, *colour)
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputConnection(strength.GetOutputPort())
    mapper.SetScalarRange(strength.GetOutput().GetPointData().GetScalars().GetRange())
    mapper.SetLookupTable(table)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.6)
    actor.GetProperty().SetDiffuse(0.4)
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("field strength [V/µm]\n ")
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.2, 0.02)
    bar.SetWidth(0.6)
    bar.SetHeight(0.12)
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.1f")
    bar.UnconstrainedFontSizeOn()
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.0, 0.0, 0.0)
        text.SetFontSize(30)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    scene = vtk.vtkRenderer()
    scene.AddActor(actor)
    scene.AddViewProp(bar)
    scene.SetBackground(1.0, 1.0, 1.0)
    window = vtk.vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetMultiSamples(8)
    window.SetSize(1200, 900)
    window.AddRenderer(scene)
    scene.ResetCamera()
    scene.GetActiveCamera().Elevation(-50.0)
    scene.ResetCamera()
    scene.GetActiveCamera().Zoom(1.45)
    # Room for the bar below.
    scene.GetActiveCamera().SetWindowCenter(0.0, -0.2)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetFileName(picture)
    writer.Write()


if __name__ == "__main__":
    main(*sys.argv[1:])
