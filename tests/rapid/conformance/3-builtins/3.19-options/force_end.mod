! rule: arguments of FCPressEnd
! source: [code] two programs that polish: a server, and a generator of paths
MODULE Demo
    PERS tooldata t;
    PERS wobjdata w;
    VAR robtarget p;
    PROC main()
        FCPressEnd p, v50, t;
        FCPressEnd p, v50 \ForceChange:=100, \ZeroContactValue:=5, t \WObj:=w;
        FCPressEnd p, v50 \ZeroContactValue:=5, t;
        FCPressEnd p, v50 \DeactOnly, t;
        FCPressEnd p, v50 \ZeroContact:=5, t;  ! -> RG312
    ENDPROC
ENDMODULE
