! rule: arguments of TextTabFreeToUse
! source: [K §11, 15]
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := TextTabFreeToUse("x");
        r_bool := TextTabFreeToUse();  ! -> RG311
        r_bool := TextTabFreeToUse("x" \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
