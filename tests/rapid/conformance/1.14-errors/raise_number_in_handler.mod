! rule: RAISE n in a handler gives the caller another error
! source: [code] ABB's Modbus modules for RobotWare 7; [K §4.8] has it in bodies only
MODULE Demo
    PROC main()
        TPErase;
    ERROR
        RAISE 5;  ! -> RG321~
    ENDPROC
ENDMODULE
