! rule: objects of one module have different names
! source: [K §2.12]
MODULE Demo
    VAR num a;
    PROC main()
        a := 1;
    ENDPROC
    LOCAL PROC a()  ! -> RG305
    ENDPROC
ENDMODULE
