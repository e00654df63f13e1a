"""Fields on a wall, read through VTK."""

import xml.etree.ElementTree as xml

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkFiltersCore import vtkCellCenters
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader


def _pieces(block, name=""):
    """Every data set in a tree of blocks, with the name of the block it belongs to."""
    if block.IsA("vtkMultiBlockDataSet"):
        for i in range(block.GetNumberOfBlocks()):
            if block.GetBlock(i) is not None:
                yield from _pieces(block.GetBlock(i), block.GetMetaData(i).Get(vtkCompositeDataSet.NAME()))
    elif block.IsA("vtkMultiPieceDataSet"):
        yield from ((name, block.GetPiece(i)) for i in range(block.GetNumberOfPieces()))
    else:
        yield name, block


def read_blocks(file):
    """The data sets of a .vtm file, each with the name of its zone or wall: one per block and rank."""
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    return list(_pieces(reader.GetOutput()))


def read_patch(file, patch):
    """Arrays of one wall patch of a .vtm file by name, with the faces' centres as "center"."""
    parts = [part for name, part in read_blocks(file) if name == patch]
    if not parts:
        raise ValueError(f"{file}: no block {patch}")
    collected = {}
    for part in parts:
        centers = vtkCellCenters()
        centers.SetInputData(part)
        centers.Update()
        arrays = part.GetCellData()
        fields = {arrays.GetArrayName(i): vtk_to_numpy(arrays.GetArray(i)) for i in range(arrays.GetNumberOfArrays())}
        fields["center"] = vtk_to_numpy(centers.GetOutput().GetPoints().GetData())
        for name, values in fields.items():
            collected.setdefault(name, []).append(values)
    return {name: np.concatenate(values) for name, values in collected.items()}


def last_fields(run):
    """The .vtm file of a run's last field output."""
    entries = xml.parse(run.folder / "fields" / "fields.pvd").iter("DataSet")
    return run.folder / "fields" / max(entries, key=lambda entry: float(entry.get("timestep"))).get("file")
