! rule: the trap of CONNECT is a name, not bound late
! source: [K §4.12]
MODULE Demo
    VAR intnum i;
    TRAP t
    ENDTRAP
    PROC main()
        CONNECT i WITH %"t"%;  ! -> RG201
        CONNECT i WITH t;
    ENDPROC
ENDMODULE
