! rule: arguments of RMQGetSlotName
! source: [manual] 3HAC050917
MODULE Demo
    VAR rmqslot v_rmqslot;
    VAR string r_string;
    PROC main()
        r_string := RMQGetSlotName(v_rmqslot);
        r_string := RMQGetSlotName();  ! -> RG311
        r_string := RMQGetSlotName(v_rmqslot \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
