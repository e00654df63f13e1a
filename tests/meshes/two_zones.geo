// Two unit cubes of tetrahedra, "left" and "right". gap > 0: apart; gap = 0: they share a surface and its nodes,
// which has the name "between" if named = 1.
DefineConstant[n = 4, gap = 0, named = 1];
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1 + gap, 0, 0, 1, 1, 1};
If (gap == 0)
  BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
EndIf
MeshSize{:} = 1 / n;
Physical Volume("left") = {1};
Physical Volume("right") = {2};
outside[] = CombinedBoundary { Volume{1, 2}; };
Physical Surface("far") = {outside[]};
If (gap == 0 && named == 1)
  between[] = Surface In BoundingBox {1 - 1e-3, -1, -1, 1 + 1e-3, 2, 2};
  Physical Surface("between") = {between[]};
EndIf
