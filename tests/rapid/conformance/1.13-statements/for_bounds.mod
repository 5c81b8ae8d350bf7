! rule: bounds and step are num
! source: [K §4.15]
MODULE Demo
    VAR num a;
    PROC main()
        FOR i FROM "1" TO 3 DO  ! -> RG307
            a := i;
        ENDFOR
    ENDPROC
ENDMODULE
