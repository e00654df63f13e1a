// Tube 0 < x < 1 with n cells along x.
// nodes = 8: hexahedra, one cell across; nodes = 4: unstructured tetrahedra, four edges across.
DefineConstant[ n = 100, nodes = 8 ];
h = 1/n;
width = (nodes == 8) ? h : 4*h;
layers = width/h;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;

Point(1) = {0, 0, 0};
line[] = Extrude {0, width, 0} { Point{1}; Layers{layers}; };
If (nodes == 8)
  floor[] = Extrude {1, 0, 0} { Curve{line[1]}; Layers{n}; Recombine; };
  tube[] = Extrude {0, 0, width} { Surface{floor[1]}; Layers{layers}; Recombine; };
Else
  floor[] = Extrude {1, 0, 0} { Curve{line[1]}; };
  tube[] = Extrude {0, 0, width} { Surface{floor[1]}; };
EndIf

Physical Volume("tube") = {tube[1]};
Physical Surface("ends") = {tube[2], tube[4]};
Physical Surface("sides") = {floor[1], tube[0], tube[3], tube[5]};
