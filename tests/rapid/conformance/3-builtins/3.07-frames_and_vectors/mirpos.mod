! rule: arguments of MirPos
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR wobjdata v_wobjdata;
    VAR robtarget r_robtarget;
    PROC main()
        r_robtarget := MirPos(v_robtarget, v_wobjdata);
        r_robtarget := MirPos(v_robtarget, v_wobjdata \WObj:=v_wobjdata \MirY);
        r_robtarget := MirPos(v_robtarget);  ! -> RG311
        r_robtarget := MirPos(v_robtarget, v_wobjdata \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
