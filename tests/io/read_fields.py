"""Reads the fields that test_fields.cpp wrote with VTK's own reader: read_fields.py DIR RANKS."""
import pathlib
import sys
import xml.etree.ElementTree as xml

import vtk
from vtk.util.numpy_support import vtk_to_numpy

folder, ranks = pathlib.Path(sys.argv[1]) / "fields", int(sys.argv[2])

entries = list(xml.parse(folder / "fields.pvd").getroot().iter("DataSet"))
times = [float(entry.get("timestep")) for entry in entries]
assert times == [0.0, 1.0 / 3.0], times
assert sorted(path.name for path in folder.iterdir()) == [
    "fields.pvd", "step_00000000", "step_00000000.vtm", "step_00000010", "step_00000010.vtm"]

reader = vtk.vtkXMLMultiBlockDataReader()
reader.SetFileName(str(folder / entries[1].get("file")))
reader.Update()
output = reader.GetOutput()
names = [output.GetMetaData(i).Get(vtk.vtkCompositeDataSet.NAME()) for i in range(output.GetNumberOfBlocks())]
assert names == ["fluid", "wing & <tip>"], names


def pieces(block):
    data = output.GetBlock(block)
    return [data.GetPiece(i) for i in range(data.GetNumberOfPieces())]


cells = sum(piece.GetNumberOfCells() for piece in pieces(0))
assert cells == 2 * ranks, cells
for rank, piece in enumerate(pieces(0)):
    assert [piece.GetCellType(i) for i in range(2)] == [vtk.VTK_HEXAHEDRON, vtk.VTK_TETRA]
    assert piece.GetPoint(8) == (0.5, 0.5, 2.0 + 1e-9), piece.GetPoint(8)
    assert piece.GetBounds()[:2] == (float(0), 1.0)
    density = vtk_to_numpy(piece.GetCellData().GetArray("density_kg_m3"))
    velocity = vtk_to_numpy(piece.GetCellData().GetArray("velocity_m_s"))
    assert density.tolist() == [1.5, rank], density
    assert velocity.tolist() == [[1, 2, 3], [4, 5, 6]], velocity
    size = vtk.vtkCellSizeFilter()
    size.SetInputData(piece)
    size.Update()
    volume = vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Volume"))
    assert abs(volume[0] - 1) < 1e-12 and abs(volume[1] - 1 / 6 * (1 + 1e-9)) < 1e-12, volume
(wall,) = pieces(1)  # only the first rank has a part of the wall
assert wall.GetNumberOfCells() == 1 and wall.GetCellType(0) == vtk.VTK_QUAD
