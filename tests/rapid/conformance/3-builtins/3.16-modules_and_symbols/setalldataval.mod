! rule: arguments of SetAllDataVal
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        SetAllDataVal "x", v_num;
        SetAllDataVal "x" \TypeMod:="x" \Object:="x" \Hidden, v_num;
        SetAllDataVal "x";  ! -> RG311
        SetAllDataVal "x", v_num \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
