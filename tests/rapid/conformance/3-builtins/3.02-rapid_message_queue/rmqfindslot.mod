! rule: arguments of RMQFindSlot
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot v_rmqslot;
    PROC main()
        RMQFindSlot v_rmqslot, "x";
        RMQFindSlot v_rmqslot;  ! -> RG311
        RMQFindSlot v_rmqslot, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
