! rule: arguments of WaitRob
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        WaitRob;
        WaitRob \InPos;
        WaitRob \ZeroSpeed;
        WaitRob 1;  ! -> RG311
        WaitRob \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
