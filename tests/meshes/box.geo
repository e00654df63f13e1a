// Box [0, lx] x [0, ly] x [0, lz] of nx x ny x nz hexahedra; a patch on each side; periodic in x, y, z where px, py, pz = 1.
DefineConstant[nx = 6, ny = 5, nz = 4, lx = 1, ly = 1, lz = 1, px = 0, py = 0, pz = 0];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, lx, ly, lz};
If (px == 1)
  Periodic Surface {2} = {1} Translate {lx, 0, 0};
EndIf
If (py == 1)
  Periodic Surface {4} = {3} Translate {0, ly, 0};
EndIf
If (pz == 1)
  Periodic Surface {6} = {5} Translate {0, 0, lz};
EndIf
along_x() = {9, 10, 11, 12};
along_y() = {2, 4, 6, 8};
along_z() = {1, 3, 5, 7};
Transfinite Curve {along_x()} = nx + 1;
Transfinite Curve {along_y()} = ny + 1;
Transfinite Curve {along_z()} = nz + 1;
Transfinite Surface {1:6};
Recombine Surface {1:6};
Transfinite Volume {1};
Physical Volume("air") = {1};
Physical Surface("xmin") = {1};
Physical Surface("xmax") = {2};
Physical Surface("ymin") = {3};
Physical Surface("ymax") = {4};
Physical Surface("zmin") = {5};
Physical Surface("zmax") = {6};
