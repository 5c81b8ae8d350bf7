! rule: arguments of CapGetFailSigs
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool result;
    VAR string v_string;
    PROC main()
        result := CapGetFailSigs(v_string);
        result := CapGetFailSigs();  ! -> RG311
    ENDPROC
ENDMODULE
