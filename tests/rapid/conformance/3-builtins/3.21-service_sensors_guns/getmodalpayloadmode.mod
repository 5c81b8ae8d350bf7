! rule: arguments of GetModalPayLoadMode
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    PROC main()
        result := GetModalPayLoadMode();
        result := GetModalPayLoadMode(1);  ! -> RG311
    ENDPROC
ENDMODULE
