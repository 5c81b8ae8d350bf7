! rule: a string of 81 characters is too long
! source: [K §2.13]
MODULE Demo
    PROC main()
        TPWrite "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx";  ! -> RG319
    ENDPROC
ENDMODULE
