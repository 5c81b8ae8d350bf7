! rule: signals are VAR parameters
! source: [K §2.16]
MODULE Demo
    PROC main()
    ENDPROC
    PROC p(VAR signaldo s)
        SetDO s, 1;
    ENDPROC
    PROC q(signaldo s)  ! -> RG328
    ENDPROC
ENDMODULE
