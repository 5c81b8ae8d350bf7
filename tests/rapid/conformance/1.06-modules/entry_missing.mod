! rule: a task has a routine to start in
! source: [K §9]
! given: system
! at 1: RG331?
MODULE Demo
    PROC start()
    ENDPROC
ENDMODULE
