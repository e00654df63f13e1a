// Unit cube of tetrahedra, n edges along each side, periodic in all directions.
DefineConstant[n = 5];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
MeshSize{:} = 1 / n;
Periodic Surface {2} = {1} Translate {1, 0, 0};
Periodic Surface {4} = {3} Translate {0, 1, 0};
Periodic Surface {6} = {5} Translate {0, 0, 1};
Physical Volume("air") = {1};
