// Slab 12.8 wide in x and y, periodic in both; edges of length h = 12.8/n.
// nodes = 8: hexahedra; nodes = 6: prisms; nodes = 4: unstructured tetrahedra, three layers.
DefineConstant[ n = 64, nodes = 8 ];
width = 12.8;
h = width/n;
layers = (nodes == 4) ? 3 : 1;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;

Point(1) = {-width/2, -width/2, 0};
Point(2) = { width/2, -width/2, 0};
Point(3) = { width/2,  width/2, 0};
Point(4) = {-width/2,  width/2, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
slab[] = Extrude {0, 0, layers*h} { Surface{1}; };

Transfinite Curve {:} = n + 1;
Transfinite Curve {11, 12, 16, 20} = layers + 1; // the four along z
If (nodes > 4)
  Transfinite Surface {:};
  Recombine Surface {slab[2], slab[3], slab[4], slab[5]};
  Transfinite Volume {slab[1]};
EndIf
If (nodes == 8)
  Recombine Surface {1, slab[0]};
EndIf
Periodic Surface {slab[3]} = {slab[5]} Translate {width, 0, 0};
Periodic Surface {slab[4]} = {slab[2]} Translate {0, width, 0};

Physical Volume("box") = {slab[1]};
Physical Surface("sides") = {1, slab[0]};
