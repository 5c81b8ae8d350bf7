!=== crossprod
! rule: arguments of CrossProd
! source: [mem]
MODULE Demo
    VAR pos r_pos;
    PROC main()
        r_pos := CrossProd([1, 2, 3], [1, 2, 3]);
        r_pos := CrossProd([1, 2, 3]);  ! -> RG311
        r_pos := CrossProd([1, 2, 3], [1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== defdframe
! rule: arguments of DefDFrame
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR pose r_pose;
    PROC main()
        r_pose := DefDFrame(v_robtarget, v_robtarget, v_robtarget, v_robtarget, v_robtarget, v_robtarget);
        r_pose := DefDFrame(v_robtarget, v_robtarget, v_robtarget, v_robtarget, v_robtarget);  ! -> RG311
        r_pose := DefDFrame(v_robtarget, v_robtarget, v_robtarget, v_robtarget, v_robtarget, v_robtarget \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== defframe
! rule: arguments of DefFrame
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR pose r_pose;
    PROC main()
        r_pose := DefFrame(v_robtarget, v_robtarget, v_robtarget);
        r_pose := DefFrame(v_robtarget, v_robtarget, v_robtarget \Origin:=1);
        r_pose := DefFrame(v_robtarget, v_robtarget);  ! -> RG311
        r_pose := DefFrame(v_robtarget, v_robtarget, v_robtarget \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== distance
! rule: arguments of Distance
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := Distance([1, 2, 3], [1, 2, 3]);
        r_num := Distance([1, 2, 3]);  ! -> RG311
        r_num := Distance([1, 2, 3], [1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== dotprod
! rule: arguments of DotProd
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := DotProd([1, 2, 3], [1, 2, 3]);
        r_num := DotProd([1, 2, 3]);  ! -> RG311
        r_num := DotProd([1, 2, 3], [1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== eulerzyx
! rule: arguments of EulerZYX
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient o;
    VAR num n;
    PROC main()
        n := EulerZYX(\X, o);
        n := EulerZYX(\Y, o);
        n := EulerZYX(\Z, o);
        n := EulerZYX(\X \Y, o);  ! -> RG313
        n := EulerZYX(\X);  ! -> RG311
    ENDPROC
ENDMODULE
!=== mirpos
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
!=== norient
! rule: arguments of NOrient
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient r_orient;
    PROC main()
        r_orient := NOrient([1, 0, 0, 0]);
        r_orient := NOrient();  ! -> RG311
        r_orient := NOrient([1, 0, 0, 0] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== offs
! rule: arguments of Offs
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR robtarget r_robtarget;
    PROC main()
        r_robtarget := Offs(v_robtarget, 1, 1, 1);
        r_robtarget := Offs(v_robtarget, 1, 1);  ! -> RG311
        r_robtarget := Offs(v_robtarget, 1, 1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== orientzyx
! rule: arguments of OrientZYX
! source: [manual] 3HAC050917
MODULE Demo
    VAR orient r_orient;
    PROC main()
        r_orient := OrientZYX(1, 1, 1);
        r_orient := OrientZYX(1, 1);  ! -> RG311
        r_orient := OrientZYX(1, 1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== orobt
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
!=== poseinv
! rule: arguments of PoseInv
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    VAR pose r_pose;
    PROC main()
        r_pose := PoseInv(v_pose);
        r_pose := PoseInv();  ! -> RG311
        r_pose := PoseInv(v_pose \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== posemult
! rule: arguments of PoseMult
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    VAR pose r_pose;
    PROC main()
        r_pose := PoseMult(v_pose, v_pose);
        r_pose := PoseMult(v_pose);  ! -> RG311
        r_pose := PoseMult(v_pose, v_pose \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== posevect
! rule: arguments of PoseVect
! source: [manual] 3HAC050917
MODULE Demo
    VAR pose v_pose;
    VAR pos r_pos;
    PROC main()
        r_pos := PoseVect(v_pose, [1, 2, 3]);
        r_pos := PoseVect(v_pose);  ! -> RG311
        r_pos := PoseVect(v_pose, [1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== reltool
! rule: arguments of RelTool
! source: [manual] 3HAC050917
MODULE Demo
    VAR robtarget v_robtarget;
    VAR robtarget r_robtarget;
    PROC main()
        r_robtarget := RelTool(v_robtarget, 1, 1, 1);
        r_robtarget := RelTool(v_robtarget, 1, 1, 1 \Rx:=1 \Ry:=1 \Rz:=1);
        r_robtarget := RelTool(v_robtarget, 1, 1);  ! -> RG311
        r_robtarget := RelTool(v_robtarget, 1, 1, 1 \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== vectmagn
! rule: arguments of VectMagn
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    PROC main()
        r_num := VectMagn([1, 2, 3]);
        r_num := VectMagn();  ! -> RG311
        r_num := VectMagn([1, 2, 3] \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
