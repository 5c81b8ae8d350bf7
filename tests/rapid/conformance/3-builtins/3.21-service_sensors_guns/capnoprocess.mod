! rule: arguments of CapNoProcess
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    PROC main()
        CapNoProcess v_num;
        CapNoProcess;  ! -> RG311?
    ENDPROC
ENDMODULE
