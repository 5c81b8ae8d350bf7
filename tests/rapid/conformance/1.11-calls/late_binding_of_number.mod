! rule: the name is a string
! source: [K §4.5]
MODULE Demo
    PROC main()
        %1%;  ! -> RG307
    ENDPROC
ENDMODULE
