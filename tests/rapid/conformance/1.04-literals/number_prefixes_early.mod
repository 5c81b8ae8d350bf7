! rule: prefixed numbers are not in RobotWare 5.0
! source: [K §2.5]
! robotware: 5.0
MODULE Demo
    VAR num a;
    PROC main()
        a := 0x1F;  ! -> RG205
    ENDPROC
ENDMODULE
