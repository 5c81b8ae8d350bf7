! rule: arguments of ORobT
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR robtarget r_robtarget;
    PROC main()
        r_robtarget := ORobT(v_robtarget);
        r_robtarget := ORobT(v_robtarget \InPDisp);
        r_robtarget := ORobT(v_robtarget \InEOffs);
        r_robtarget := ORobT();  ! -> RG311
        r_robtarget := ORobT(v_robtarget \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
