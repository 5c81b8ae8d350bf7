! rule: a name that no procedure has
! source: [K §4.5, 12]
! given: system
MODULE Demo
    PROC main()
        %"nothing"%;  ! -> RG301?
        %":nothing"%;  ! -> RG301?
        %"other:thing"%;
    ENDPROC
ENDMODULE
