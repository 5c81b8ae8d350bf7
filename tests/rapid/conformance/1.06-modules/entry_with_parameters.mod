! rule: a task starts in a routine without parameters
! source: [K §9]
! given: system
MODULE Demo
    PROC main(num speed)  ! -> RG331
        VelSet speed, speed;
    ENDPROC
ENDMODULE
