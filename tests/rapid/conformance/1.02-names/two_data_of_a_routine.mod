! rule: data of one routine have different names
! source: [K §2.20]
MODULE Demo
    VAR num b;
    PROC main()
        VAR num a;
        VAR num A;  ! -> RG305
        a := 1;
        b := a;
    ENDPROC
ENDMODULE
