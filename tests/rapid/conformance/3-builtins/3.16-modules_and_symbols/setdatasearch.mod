! rule: arguments of SetDataSearch
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SetDataSearch "x";
        SetDataSearch "x" \TypeMod:="x" \Object:="x" \PersSym \VarSym \ConstSym \InTask \InRout:="x" \GlobalSym;
        SetDataSearch "x" \TypeMod:="x" \Object:="x" \PersSym \VarSym \ConstSym \InMod:="x" \InRout:="x" \LocalSym;
        SetDataSearch;  ! -> RG311?
        SetDataSearch "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
