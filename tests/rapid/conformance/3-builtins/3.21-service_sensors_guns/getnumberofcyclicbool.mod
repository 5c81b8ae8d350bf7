! rule: arguments of GetNumberOfCyclicBool
! source: [manual] 3HAC050917
MODULE Demo
    VAR num result;
    PROC main()
        result := GetNumberOfCyclicBool();
        result := GetNumberOfCyclicBool(1);  ! -> RG311?
    ENDPROC
ENDMODULE
