! rule: the name of a module hides a predefined object
! source: [K §9.1]
MODULE Stop
    PROC main()
        Stop;  ! -> RG306
    ENDPROC
ENDMODULE
