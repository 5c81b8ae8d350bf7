! rule: arguments of HollowWristReset
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        HollowWristReset;
        HollowWristReset 1;  ! -> RG311?
    ENDPROC
ENDMODULE
