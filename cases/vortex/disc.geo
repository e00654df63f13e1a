// Disc of radius 6.4 about the z axis, far field around it; edges of length about h = 12.8/n.
// nodes = 8: hexahedra, a square with four blocks around it; nodes = 6: prisms, unstructured in the plane;
// nodes = 4: unstructured tetrahedra, three layers.
DefineConstant[ n = 64, nodes = 8 ];
radius = 6.4;
core = 0.45*radius; // half diagonal of the square
h = 2*radius/n;
thickness = (nodes == 4) ? 3*h : h;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;

Point(1) = {0, 0, 0};
For k In {0:3}
  angle = Pi/4 + k*Pi/2;
  Point(10 + k) = {radius*Cos(angle), radius*Sin(angle), 0};
  Point(20 + k) = {core*Cos(angle), core*Sin(angle), 0};
EndFor
For k In {0:3}
  Circle(10 + k) = {10 + k, 1, 10 + (k + 1)%4};
EndFor

If (nodes == 8)
  For k In {0:3}
    Line(20 + k) = {20 + k, 20 + (k + 1)%4};
    Line(30 + k) = {20 + k, 10 + k};
  EndFor
  Transfinite Curve {10:13, 20:23} = n/2 + 1;
  Transfinite Curve {30:33} = n/4 + 1;
  Curve Loop(14) = {20:23};
  Plane Surface(14) = {14};
  For k In {0:3}
    Curve Loop(10 + k) = {10 + k, -(30 + (k + 1)%4), -(20 + k), 30 + k};
    Plane Surface(10 + k) = {10 + k};
  EndFor
  Transfinite Surface {10:14};
  Recombine Surface {10:14};
  base[] = {10:14};
Else
  Curve Loop(10) = {10:13};
  Plane Surface(10) = {10};
  base[] = {10};
EndIf

volume[] = {};
sides[] = {base[]};
rim[] = {};
For k In {0:#base[] - 1}
  If (nodes == 4)
    out[] = Extrude {0, 0, thickness} { Surface{base[k]}; };
  Else
    out[] = Extrude {0, 0, thickness} { Surface{base[k]}; Layers{1}; Recombine; };
  EndIf
  sides[] += out[0];
  volume[] += out[1];
  If (nodes == 8 && k < 4)
    rim[] += out[2];
  ElseIf (nodes < 8)
    rim[] += out[{2:5}];
  EndIf
EndFor

Physical Volume("disc") = {volume[]};
Physical Surface("sides") = {sides[]};
Physical Surface("rim") = {rim[]};
