"""Fields on a wall, read through VTK."""

import xml.etree.ElementTree as xml

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkFiltersCore import vtkCellCenters
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader


def _leaves(block, name=""):
    if not block.IsA("vtkMultiBlockDataSet"):
        yield name, block
        return
    for i in range(block.GetNumberOfBlocks()):
        child, meta = block.GetBlock(i), block.GetMetaData(i)
        if child is not None:
            yield from _leaves(child, meta.Get(vtkCompositeDataSet.NAME()) or name)


def read_patch(file, patch):
    """Arrays of one wall patch of a .vtm file by name, with the faces' centres as "center"."""
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    parts = [part for name, part in _leaves(reader.GetOutput()) if name == patch]
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
