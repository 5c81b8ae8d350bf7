! rule: a trap is started by its interrupt only
! source: [K §5]
MODULE Demo
    PROC main()
        t;  ! -> RG306
    ENDPROC
    TRAP t
    ENDTRAP
ENDMODULE
